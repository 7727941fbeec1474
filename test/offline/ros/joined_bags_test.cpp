// SPDX-License-Identifier: BSD-3-Clause
// Several bags are read as one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <memory>

#include "common/ros/geometry_conversion.h"
#include "offline/recordings/bag_recording.h"
#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MessageOf;
using testing::ReadAll;
using testing::RecordingContents;

constexpr int64_t kStart_ns = 1'500'000'000'000'000'000;
constexpr int64_t kStep_ns = 10'000'000;

class JoinedBagsTest : public ::testing::Test {
 protected:
  // A bag of the samples from `begin` to before `end`, every fourth with an image.
  std::string Write(const std::string& name, int begin, int end, bool images = true,
                    bool imu = true) {
    rosbag::Bag bag(folder_.File(name), rosbag::bagmode::Write);
    for (int i = begin; i < end; ++i) {
      const ros::Time time = ToRosTime(kStart_ns + i * kStep_ns);
      if (imu) {
        sensor_msgs::Imu sample;
        sample.header.stamp = time;
        sample.linear_acceleration.z = 9.81;
        bag.write("/imu0", time, sample);
      }
      if (images && i % 4 == 0) {
        sensor_msgs::Image image;
        image.header.stamp = time;
        image.encoding = "mono8";
        image.width = image.height = image.step = 1;
        image.data = {static_cast<uint8_t>(i)};
        bag.write("/cam0", time + ros::Duration(0.001), image);
      }
    }
    return folder_.File(name);
  }

  static std::unique_ptr<Recording> Open(const std::vector<std::string>& files) {
    return OpenBags(files, {"/cam0"}, "/imu0");
  }

  static void ExpectAreAlike(const RecordingContents& a, const RecordingContents& b) {
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.stamps, b.stamps);
    EXPECT_EQ(a.problems, b.problems);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(JoinedBagsTest, EqualOneBagInOrderOfTime) {
  const auto whole = Open({Write("whole.bag", 0, 90)});
  const auto parts = Open({Write("a.bag", 60, 90), Write("b.bag", 0, 25), Write("c.bag", 25, 60)});
  ExpectAreAlike(ReadAll(parts.get()), ReadAll(whole.get()));
  EXPECT_EQ(parts->end_ns(), whole->end_ns());
  EXPECT_EQ(parts->name(),
            folder_.File("a.bag") + " " + folder_.File("b.bag") + " " + folder_.File("c.bag"));
}

TEST_F(JoinedBagsTest, MayEachHaveOneOfTheTopics) {
  const auto whole = Open({Write("whole.bag", 0, 50)});
  const auto imu = Write("imu.bag", 0, 50, /*images=*/false, /*imu=*/true);
  const auto images = Write("images.bag", 0, 50, /*images=*/true, /*imu=*/false);
  ExpectAreAlike(ReadAll(Open({imu, images}).get()), ReadAll(whole.get()));
  EXPECT_THAT(MessageOf([&] {
                Open({imu, imu});
              }),
              AllOf(HasSubstr(imu + " " + imu + " has no topic /cam0"), HasSubstr("image_topic")));
}

TEST_F(JoinedBagsTest, ErrorNamesTheUnreadableBag) {
  folder_.Write("bad.bag", "nothing");
  const std::string good = Write("good.bag", 0, 10);
  EXPECT_THAT(MessageOf([&] {
                Open({good, folder_.File("bad.bag")});
              }),
              HasSubstr(folder_.File("bad.bag") + " is not a ROS bag"));
}

}  // namespace
}  // namespace plm_vins
