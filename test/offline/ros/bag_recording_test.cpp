// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_recording.h"

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
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/ros/geometry_conversion.h"
#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MessageOf;
using ::testing::Not;
using testing::ReadAll;
using testing::RecordingContents;

constexpr int64_t kStart = 1'500'000'000'000'000'000;
constexpr int64_t kStep = 10'000'000;  // IMU at 100 Hz, an image every fifth time
constexpr int kSamples = 200;
constexpr int kImages = 40;

ros::Time Stamp(int i) { return ToRosTime(kStart + i * kStep); }

// A picture that is not very compressible, with its number in the first pixel.
cv::Mat Picture(int i) {
  cv::Mat picture(48, 64, CV_8UC1);
  cv::randu(picture, 0, 256);
  picture.at<uint8_t>(0, 0) = static_cast<uint8_t>(i);
  return picture;
}

sensor_msgs::Image RawImage(int i) {
  const cv::Mat picture = Picture(i);
  sensor_msgs::Image image;
  image.header.stamp = Stamp(i);
  image.encoding = "mono8";
  image.width = picture.cols;
  image.height = picture.rows;
  image.step = picture.cols;
  image.data.assign(picture.data, picture.data + picture.total());
  return image;
}

sensor_msgs::CompressedImage CompressedImage(int i) {
  sensor_msgs::CompressedImage image;
  image.header.stamp = Stamp(i);
  image.format = "mono8; png compressed";
  cv::imencode(".png", Picture(i), image.data);
  return image;
}

sensor_msgs::Imu Imu(int i) {
  sensor_msgs::Imu imu;
  imu.header.stamp = Stamp(i);
  imu.angular_velocity.x = i;
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
  bag->write(topic, Stamp(i), message, header);
}

class BagRecording : public ::testing::Test {
 protected:
  template <typename MakeImage>
  void WriteBag(const std::string& image_topic, const MakeImage& make_image,
                rosbag::CompressionType compression = rosbag::compression::Uncompressed,
                uint32_t chunk_size = 20000) {  // several chunks even in a small bag
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(chunk_size);
    bag.write("/other", Stamp(0), std_msgs::Bool());
    WriteMessages(image_topic, make_image, &bag);
  }

  template <typename MakeImage>
  void WriteMessages(const std::string& image_topic, const MakeImage& make_image,
                     rosbag::Bag* bag) {
    for (int i = 0; i < kSamples; ++i) {
      bag->write("/imu0", Stamp(i), Imu(i));
      if (i % 5 == 0) bag->write(image_topic, Stamp(i), make_image(i));
    }
  }

  void Truncate(double share) {
    const auto size = static_cast<double>(std::filesystem::file_size(file_));
    std::filesystem::resize_file(file_, static_cast<uintmax_t>(share * size));
  }

  RecordingContents Read() {
    return ReadAll(OpenBags({file_}, {"/cam0/image_raw"}, "/imu0").get());
  }

  void ExpectComplete(const RecordingContents& contents) {
    EXPECT_EQ(contents.imu.size(), static_cast<size_t>(kSamples));
    ASSERT_EQ(contents.images.size(), static_cast<size_t>(kImages));
    for (int i = 0; i < kImages; ++i) EXPECT_EQ(contents.images[i].at<uint8_t>(0, 0), 5 * i);
    EXPECT_EQ(contents.stamps.front(), kStart);
    EXPECT_EQ(contents.stamps.back(), kStart + (kSamples - 1) * kStep);
  }

  testing::TemporaryFolder folder_;
  std::string file_ = folder_.File("test.bag");
};

TEST_F(BagRecording, ReadsRawImages) {
  WriteBag("/cam0/image_raw", RawImage);
  const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
  EXPECT_EQ(recording->end_ns(), kStart + (kSamples - 1) * kStep);
  const RecordingContents contents = ReadAll(recording.get());
  ExpectComplete(contents);
  EXPECT_EQ(contents.problems.at("bag_damaged"), 0);
}

TEST_F(BagRecording, NamesTheKeysOfItsTopics) {
  WriteBag("/cam0/image_raw", RawImage);
  {
    rosbag::Bag bag(file_, rosbag::bagmode::Append);
    for (const char* topic : {"/cam1", "/depth"}) bag.write(topic, Stamp(0), RawImage(0));
  }
  using Kind = RecordingEvent::Kind;
  const auto recording = OpenBags({file_}, {"/cam0/image_raw", "/cam1"}, "/imu0", "/depth");
  EXPECT_EQ(recording->Source(Kind::kImage), "image_topic /cam0/image_raw");
  EXPECT_EQ(recording->Source(Kind::kDepth), "depth_topic /depth");
  EXPECT_EQ(recording->Source(Kind::kImu), "imu_topic /imu0");
}

TEST_F(BagRecording, ReadsCompressedImagesBesideTheTopic) {
  WriteBag("/cam0/image_raw/compressed", CompressedImage);
  const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
  ExpectComplete(ReadAll(recording.get()));
  EXPECT_EQ(recording->Source(RecordingEvent::Kind::kImage),
            "image_topic /cam0/image_raw/compressed");
}

TEST_F(BagRecording, ReadsCompressedImagesOnTheTopicItself) {
  WriteBag("/cam0/image_raw", CompressedImage);
  ExpectComplete(Read());
}

TEST_F(BagRecording, ErrorListsExistingTopics) {
  WriteBag("/camera/left", RawImage);
  EXPECT_THAT(MessageOf([&] { Read(); }),
              AllOf(HasSubstr(file_ + " has no topic /cam0/image_raw (sensor_msgs/Image"),
                    HasSubstr("key image_topic"), Not(HasSubstr("imu_topic")),
                    HasSubstr("/camera/left (sensor_msgs/Image)"),
                    HasSubstr("/imu0 (sensor_msgs/Imu)"), HasSubstr("/other (std_msgs/Bool)")));
}

TEST_F(BagRecording, ErrorNamesBothMissingTopicsAndTheirKeys) {
  WriteBag("/camera/left", RawImage);
  EXPECT_THAT(MessageOf([&] { OpenBags({file_}, {"/cam0"}, "/imu"); }),
              AllOf(HasSubstr("no topic /cam0 ("), HasSubstr("key image_topic"),
                    HasSubstr("no topic /imu ("), HasSubstr("key imu_topic")));
}

TEST_F(BagRecording, FindsATopicWithoutALeadingSlash) {
  WriteBag("cam0/image_raw", RawImage);
  ExpectComplete(Read());
  ExpectComplete(ReadAll(OpenBags({file_}, {"cam0/image_raw"}, "imu0").get()));
}

TEST_F(BagRecording, RejectsATopicOfAnotherType) {
  WriteBag("/cam0/image_raw", RawImage);
  EXPECT_THAT(MessageOf([&] { OpenBags({file_}, {"/cam0/image_raw"}, "/other"); }),
              HasSubstr("no topic /other (sensor_msgs/Imu)"));
}

TEST_F(BagRecording, NamesTheRemedyForATruncatedBag) {
  WriteBag("/cam0/image_raw", RawImage);
  Truncate(0.7);
  EXPECT_THAT(MessageOf([&] { Read(); }), HasSubstr("\"rosbag reindex " + file_ + "\""));
}

// The data after the chunk are still read.
TEST_F(BagRecording, DropsAChunkThatDoesNotUnpack) {
  WriteBag("/cam0/image_raw", RawImage, rosbag::compression::BZ2);
  std::string bytes = folder_.Read("test.bag");
  const size_t chunk = bytes.find("compression=", bytes.size() / 2);
  for (size_t i = 200; i < 220; ++i) bytes[chunk + i] ^= '\x55';
  folder_.Write("test.bag", bytes);
  const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
  const RecordingContents contents = ReadAll(recording.get());
  EXPECT_GT(contents.imu.size(), size_t{kSamples / 2});
  EXPECT_LT(contents.imu.size(), size_t{kSamples});
  EXPECT_EQ(contents.stamps.back(), kStart + (kSamples - 1) * kStep);
  EXPECT_EQ(contents.problems.at("bag_damaged"),
            kSamples + kImages - static_cast<int64_t>(contents.stamps.size()));
  EXPECT_THAT(recording->problems().front().detail, HasSubstr("rosbag reindex"));
}

TEST_F(BagRecording, NamesTheRemedyForABagThatWasNeverClosed) {
  rosbag::Bag bag(folder_.File("open.bag"), rosbag::bagmode::Write);
  for (int i = 0; i < kSamples; ++i) bag.write("/imu0", Stamp(i), Imu(i));
  file_ = folder_.File("copy.bag");  // as after a crash of the recorder
  std::filesystem::copy_file(folder_.File("open.bag"), file_);
  EXPECT_THAT(MessageOf([&] { Read(); }), HasSubstr("rosbag reindex"));
}

TEST_F(BagRecording, EveryTruncationIsReadOrRejectedWithoutACrash) {
  WriteBag("/cam0/image_raw", RawImage);
  for (double share = 0.99; share > 0; share -= 0.07) {
    Truncate(share);
    const std::string message = MessageOf([&] { Read(); });
    EXPECT_THAT(message, AnyOf(IsEmpty(), HasSubstr(file_)));
  }
}

TEST_F(BagRecording, RejectsOtherFiles) {
  folder_.Write("test.bag", "PNG or whatever\n");
  EXPECT_THAT(MessageOf([&] { Read(); }), HasSubstr("is not a ROS bag"));
  folder_.Write("test.bag", "");
  EXPECT_THAT(MessageOf([&] { Read(); }), HasSubstr("is not a ROS bag"));
  file_ = folder_.File("missing.bag");
  EXPECT_THAT(MessageOf([&] { Read(); }),
              AllOf(HasSubstr("cannot read " + file_), HasSubstr("No such file")));
  file_ = folder_.path();
  EXPECT_THAT(MessageOf([&] { Read(); }), HasSubstr("is not a file"));
}

TEST_F(BagRecording, CountsImagesOfUnknownEncodingAndContinues) {
  WriteBag("/cam0/image_raw", [](int i) {
    sensor_msgs::Image image = RawImage(i);
    if (i == 10) image.encoding = "secret";
    return image;
  });
  const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
  const RecordingContents contents = ReadAll(recording.get());
  EXPECT_EQ(contents.images.size(), static_cast<size_t>(kImages - 1));
  EXPECT_EQ(contents.problems.at("images_unreadable"), 1);
}

// The messages come before or after the images.
TEST_F(BagRecording, MessagesOfAnotherTypeAreCountedAndSkipped) {
  for (const int stray_at : {-1, kSamples}) {
    {
      rosbag::Bag bag(file_, rosbag::bagmode::Write);
      WriteApart("/imu0", stray_at, std_msgs::Bool(), &bag);
      WriteApart("/cam0/image_raw", stray_at, std_msgs::Bool(), &bag);
      WriteApart("/cam0/image_raw", stray_at, sensor_msgs::CompressedImage(), &bag);
      WriteMessages("/cam0/image_raw", RawImage, &bag);
    }
    const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
    const RecordingContents contents = ReadAll(recording.get());
    ExpectComplete(contents);
    EXPECT_EQ(contents.problems.at("messages_malformed"), 0);
    EXPECT_EQ(contents.problems.at("messages_of_another_type"), 3);
    const DropCounts problems = recording->problems();
    const auto others = std::find_if(problems.begin(), problems.end(), [](const DropCount& drop) {
      return drop.cause == "messages_of_another_type";
    });
    EXPECT_THAT(others->detail, HasSubstr(" on /"));
  }
}

TEST_F(BagRecording, ATopicMayHaveImagesAndSamples) {
  {
    rosbag::Bag bag(file_, rosbag::bagmode::Write);
    for (int i = 0; i < kSamples; ++i) {
      bag.write("/data", Stamp(i), Imu(i));
      if (i % 5 == 0) WriteApart("/data", i, RawImage(i), &bag);
    }
  }
  ExpectComplete(ReadAll(OpenBags({file_}, {"/data"}, "/data").get()));
}

TEST_F(BagRecording, NamesTheTopicOfAMessageThatIsMalformed) {
  WriteBag("/cam0/image_raw", RawImage);
  std::string bytes = folder_.Read("test.bag");
  const std::string before_size = std::string("mono8") + '\0' + std::string("\x40\0\0\0", 4);
  bytes.replace(bytes.find(before_size) + before_size.size(), 4, std::string("\0\x10\0\0", 4));
  folder_.Write("test.bag", bytes);
  const auto recording = OpenBags({file_}, {"/cam0/image_raw"}, "/imu0");
  ReadAll(recording.get());
  EXPECT_EQ(ToString(recording->problems().back()),
            "messages_malformed: 1 (first: sensor_msgs/Image on /cam0/image_raw)");
}

}  // namespace
}  // namespace plm_vins
