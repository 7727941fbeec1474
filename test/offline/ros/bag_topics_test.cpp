// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <memory>
#include <string>

#include "common/ros/geometry_conversion.h"
#include "offline/recordings/bag_recording.h"
#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using testing::ReadAll;
using testing::RecordingContents;

constexpr int64_t kTopicsStart = 1'500'000'000'000'000'000;
constexpr int64_t kTopicsStep = 10'000'000;  // IMU at 100 Hz, an image every fifth time
constexpr int kTopicsSamples = 100;
constexpr int kTopicsImages = 20;

ros::Time TopicStamp(int i) { return ToRosTime(kTopicsStart + i * kTopicsStep); }

sensor_msgs::Image Image(int i) {
  sensor_msgs::Image image;
  image.header.stamp = TopicStamp(i);
  image.encoding = "mono8";
  image.width = image.step = 64;
  image.height = 48;
  image.data.assign(64 * 48, static_cast<uint8_t>(i));
  return image;
}

sensor_msgs::Imu TopicImu(int i) {
  sensor_msgs::Imu imu;
  imu.header.stamp = TopicStamp(i);
  imu.linear_acceleration.z = 9.81;
  return imu;
}

// Writes as a separate publisher. Without this header, all messages of a topic have one type in the
// bag.
template <typename Message>
void WriteApart(const std::string& topic, int i, const Message& message, rosbag::Bag* bag) {
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = topic;
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  bag->write(topic, TopicStamp(i), message, header);
}

class BagTopics : public ::testing::Test {
 protected:
  void WriteImages(rosbag::Bag* bag) {
    for (int i = 0; i < kTopicsSamples; i += 5)
      bag->write("/cam0/image_raw", TopicStamp(i), Image(i));
  }
  void WriteImu(rosbag::Bag* bag) {
    for (int i = 0; i < kTopicsSamples; ++i) bag->write("/imu0", TopicStamp(i), TopicImu(i));
  }

  std::unique_ptr<Recording> Open() { return OpenBags({file_}, {"/cam0/image_raw"}, "/imu0"); }

  void ExpectComplete(const RecordingContents& contents) {
    EXPECT_EQ(contents.images.size(), size_t{kTopicsImages});
    EXPECT_EQ(contents.imu.size(), size_t{kTopicsSamples});
    EXPECT_EQ(contents.problems.at("messages_malformed"), 0);
    EXPECT_EQ(contents.problems.at("bag_damaged"), 0);
  }

  testing::TemporaryFolder folder_;
  std::string file_ = folder_.File("test.bag");
};

// The messages come before or after the images.
TEST_F(BagTopics, MessagesOfAnotherTypeAreCountedAndSkipped) {
  for (const int stray_at : {-1, kTopicsSamples}) {
    {
      rosbag::Bag bag(file_, rosbag::bagmode::Write);
      WriteApart("/imu0", stray_at, std_msgs::Bool(), &bag);
      WriteApart("/cam0/image_raw", stray_at, std_msgs::Bool(), &bag);
      WriteApart("/cam0/image_raw", stray_at, sensor_msgs::CompressedImage(), &bag);
      WriteImages(&bag);
      WriteImu(&bag);
    }
    const auto recording = Open();
    const RecordingContents contents = ReadAll(recording.get());
    ExpectComplete(contents);
    EXPECT_EQ(contents.problems.at("messages_of_another_type"), 3);
    const DropCounts problems = recording->problems();
    const auto others = std::find_if(problems.begin(), problems.end(), [](const DropCount& drop) {
      return drop.cause == "messages_of_another_type";
    });
    EXPECT_THAT(others->detail, HasSubstr(" on /"));
  }
}

TEST_F(BagTopics, ATopicMayHaveImagesAndSamples) {
  {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    for (int i = 0; i < kTopicsSamples; ++i) {
      bag.write("/data", TopicStamp(i), TopicImu(i));
      if (i % 5 == 0) WriteApart("/data", i, Image(i), &bag);
    }
  }
  ExpectComplete(ReadAll(OpenBags({file_}, {"/data"}, "/data").get()));
}

TEST_F(BagTopics, NamesTheTopicOfAMessageThatIsMalformed) {
  {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    WriteImages(&bag);
    WriteImu(&bag);
  }
  std::string bytes = folder_.Read("test.bag");
  const std::string before_size = std::string("mono8") + '\0' + std::string("\x40\0\0\0", 4);
  bytes.replace(bytes.find(before_size) + before_size.size(), 4, std::string("\0\x10\0\0", 4));
  folder_.Write("test.bag", bytes);
  const auto recording = Open();
  ReadAll(recording.get());
  EXPECT_EQ(ToString(recording->problems().back()),
            "messages_malformed: 1 (first: sensor_msgs/Image on /cam0/image_raw)");
}

}  // namespace
}  // namespace plm_vins
