// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/image_conversion.h"
#include "common/ros/keyframe_conversion.h"
#include "common/ros/msg_conversion.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

// A message with arbitrary content, as a node's callback may receive it; roscpp has checked
// lengths.
sensor_msgs::PointCloud AnyCloud(Reader* reader) {
  sensor_msgs::PointCloud cloud;
  cloud.header.stamp.sec = reader->Value<uint32_t>();
  cloud.points.resize(reader->Byte());
  cloud.channels.resize(reader->Byte() % 8);
  for (geometry_msgs::Point32& point : cloud.points) {
    point.x = reader->Value<float>();
    point.y = reader->Value<float>();
  }
  for (sensor_msgs::ChannelFloat32& channel : cloud.channels) {
    const bool fits = reader->Byte() % 8 != 0;
    channel.values.resize(fits ? cloud.points.size() : reader->Byte());
    for (float& value : channel.values) {
      value = reader->Byte() % 8 != 0 ? reader->Byte() : reader->Value<float>();
    }
  }
  return cloud;
}

sensor_msgs::Image AnyImage(Reader* reader) {
  static const char* const encodings[] = {"mono8", "mono16", "bgr8",  "rgba8", "bayer_rggb8",
                                          "32FC1", "",       "8UC99", "yuv422"};
  sensor_msgs::Image image;
  image.encoding = encodings[reader->Byte() % std::size(encodings)];
  image.is_bigendian = reader->Byte() % 2;
  const bool small = reader->Byte() % 4 != 0;
  image.width = small ? reader->Byte() : reader->Value<uint32_t>();
  image.height = small ? reader->Byte() : reader->Value<uint32_t>();
  image.step = small ? image.width * (1 + reader->Byte() % 8) : reader->Value<uint32_t>();
  if (reader->Byte() % 4 == 0) image.step += 1U << (24 + reader->Byte() % 8);
  const uint32_t whole = image.step * image.height;  // in 32 bits, as cv_bridge computes the size
  image.data.resize(std::min<size_t>(small ? whole : reader->Value<uint16_t>(), 1 << 20));
  return image;
}

// Runs a conversion, whatever the previous ones threw.
template <typename Conversion>
void Try(Conversion conversion) {
  try {
    conversion();
  } catch (const std::exception&) {
  }
}

Target MessagesTarget() {
  Bytes seed;
  for (int i = 0; i < 600; ++i) seed.push_back(static_cast<uint8_t>(7 * i));
  // AnyImage() converts this to mono8, 128 x 128 pixels, with rows of 128 + 2^25 bytes.
  const Bytes rows_far_apart = {0, 1, 128, 128, 0, 0, 1};
  return {
      "messages", {seed, rows_far_apart}, [](const Bytes& bytes) {
        int64_t left_out = 0;
        Try([&, reader = Reader(bytes)]() mutable { ToPointFrame(AnyCloud(&reader), &left_out); });
        Try([&, reader = Reader(bytes)]() mutable { ToLineFrame(AnyCloud(&reader), &left_out); });
        Try([&, reader = Reader(bytes)]() mutable { ToCorners(AnyCloud(&reader), &left_out); });
        Try([&, reader = Reader(bytes)]() mutable { ToSegments(AnyCloud(&reader), &left_out); });
        Try([&, reader = Reader(bytes)]() mutable { ToImageSample(AnyImage(&reader)); });
        sensor_msgs::CompressedImage compressed;
        compressed.data = bytes;
        Try([&] { ToImageSample(compressed); });
      }};
}

}  // namespace

std::vector<Target> Targets() { return {MessagesTarget()}; }

}  // namespace plm_vins::fuzz
