// SPDX-License-Identifier: BSD-3-Clause
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/ros/msg_conversion.h"
#include "offline/bag_recording.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

std::string BagFile() {
  const auto name = "plm_vins_fuzz_" + std::to_string(getpid()) + ".bag";
  return (std::filesystem::temp_directory_path() / name).string();
}

sensor_msgs::Image Image(int64_t t_ns) {
  sensor_msgs::Image image;
  image.header.stamp = ToRosTime(t_ns);
  image.encoding = "mono8";
  image.width = image.step = 16;
  image.height = 12;
  image.data.assign(16 * 12, 100);
  return image;
}

Bytes SmallBag(rosbag::compression::CompressionType compression) {
  rosbag::Bag bag(BagFile(), rosbag::bagmode::Write);
  bag.setCompression(compression);
  for (int i = 0; i < 20; ++i) {
    const int64_t t_ns = 1'500'000'000'000'000'000 + 5'000'000 * i;
    sensor_msgs::Imu imu;
    imu.header.stamp = ToRosTime(t_ns);
    imu.linear_acceleration.z = 9.81;
    bag.write("/imu0", imu.header.stamp, imu);
    if (i % 10 == 0) bag.write("/cam0/image_raw", imu.header.stamp, Image(t_ns));
  }
  bag.close();
  std::ostringstream text;
  text << std::ifstream(BagFile(), std::ios::binary).rdbuf();
  return ToBytes(text.str());
}

template <typename Message>
Bytes Serialize(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <typename Message>
Message Deserialize(Bytes bytes) {
  Message message;
  ros::serialization::IStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, message);
  return message;
}

sensor_msgs::PointCloud Points() {
  PointFrame frame;
  frame.t_ns = 1'500'000'000'000'000'000;
  for (int i = 0; i < 5; ++i) frame.points.push_back({i, {0.1 * i, 0.2}, {10, 20}, {1, -1}});
  return ToMessage(frame, "camera");
}

sensor_msgs::PointCloud Lines() {
  LineFrame frame;
  frame.t_ns = 1'500'000'000'000'000'000;
  for (int i = 0; i < 5; ++i) frame.lines.push_back({i, {0.1 * i, 0.2}, {0.1, -0.4}});
  return ToMessage(frame, "camera");
}

// One conversion after the other, whatever the one before says.
template <typename Conversion>
void Try(Conversion conversion) {
  try {
    conversion();
  } catch (const std::exception&) {
  }
}

}  // namespace

Target BagTarget() {
  const std::vector<Bytes> seeds = {SmallBag(rosbag::compression::Uncompressed),
                                    SmallBag(rosbag::compression::BZ2),
                                    SmallBag(rosbag::compression::LZ4)};
  return {"bag", seeds, [](const Bytes& bytes) {
            std::ofstream(BagFile(), std::ios::binary) << ToText(bytes);
            const auto recording = OpenBag(BagFile(), "/cam0/image_raw", "/imu0");
            while (const auto event = recording->Next()) {
              if (event->kind == RecordingEvent::Kind::kImage) recording->LoadImage();
            }
          }};
}

Target MessagesTarget() {
  const std::vector<Bytes> seeds = {Serialize(Points()), Serialize(Lines()),
                                    Serialize(Image(1'500'000'000'000'000'000)),
                                    Serialize(sensor_msgs::Imu())};
  return {"messages", seeds, [](const Bytes& bytes) {
            int64_t left_out = 0;
            Try([&] { ToPointFrame(Deserialize<sensor_msgs::PointCloud>(bytes), &left_out); });
            Try([&] { ToLineFrame(Deserialize<sensor_msgs::PointCloud>(bytes), &left_out); });
            Try([&] { ToImuSample(Deserialize<sensor_msgs::Imu>(bytes)); });
            Try([&] { ToImageSample(Deserialize<sensor_msgs::Image>(bytes)); });
            Try([&] { ToImageSample(Deserialize<sensor_msgs::CompressedImage>(bytes)); });
          }};
}

}  // namespace plm_vins::fuzz
