// SPDX-License-Identifier: BSD-3-Clause
// Sends points, lines and IMU samples in the format of VINS-Mono and PL-VINS to the estimator's
// node, with lines in time, late or missing. Run by lines.test.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>

#include <cstdint>
#include <string>
#include <vector>

#include "test/ros/estimator_log.h"

namespace {

using plm_vins::testing::EstimatorLog;

constexpr double kStart = 1000;   // [s]
constexpr double kPeriod = 0.05;  // of the images [s]
constexpr int kImuPerImage = 10;

ros::Time ImageStamp(int image) { return ros::Time(kStart + kPeriod * image); }

// `count` stationary features.
sensor_msgs::PointCloud Features(int image, int count, const std::vector<std::string>& channels) {
  sensor_msgs::PointCloud cloud;
  cloud.header.stamp = ImageStamp(image);
  cloud.points.resize(count);
  for (const std::string& name : channels) {
    cloud.channels.emplace_back();
    cloud.channels.back().name = name;
    cloud.channels.back().values.assign(count, 0.1F);
  }
  for (int i = 0; i < count; ++i) {
    cloud.points[i].x = 0.01F * static_cast<float>(i);
    cloud.points[i].z = 1;
    cloud.channels[0].values[i] = static_cast<float>(i);
  }
  return cloud;
}

class Lines : public ::testing::Test {
 protected:
  struct Counts {
    int64_t frames = 0;
    int64_t without_lines = 0;
    std::string message;
  };

  static void SetUpTestSuite() { feed_ = new Feed(); }
  static void TearDownTestSuite() { delete feed_; }

  // Publishes `images` images with lines `lag` images late (none if negative), before or after the
  // points. Returns the counts of the node.
  static Counts Play(int images, int lag, bool lines_first = false) {
    const Counts before = feed_->Read();
    for (int i = 0; i < images; ++i) feed_->PublishImage(lag, lines_first);
    Counts after = feed_->Read();
    after.frames -= before.frames;
    after.without_lines -= before.without_lines;
    return after;
  }

 private:
  struct Feed {
    Feed() {
      while (ros::ok() &&
             points.getNumSubscribers() * lines.getNumSubscribers() * imu.getNumSubscribers() ==
                 0) {
        ros::WallDuration(0.05).sleep();
      }
    }

    void PublishImage(int lag, bool lines_first) {
      ++image;
      for (int i = 1; i <= kImuPerImage; ++i) {
        sensor_msgs::Imu sample;
        sample.header.stamp = ros::Time(kStart + kPeriod * (image - 1 + 1.0 * i / kImuPerImage));
        sample.linear_acceleration.x = 9.81;
        imu.publish(sample);
      }
      const auto publish_lines = [&] {
        if (lag >= 0) lines.publish(Features(image - lag, 40, {"id", "x_end", "y_end"}));
      };
      if (lines_first) publish_lines();
      points.publish(Features(image, 60, {"id", "u", "v", "vx", "vy"}));
      if (!lines_first) publish_lines();
      ros::WallDuration(kPeriod).sleep();
      ros::spinOnce();
    }

    // Reads the counts after all published messages are processed.
    Counts Read() {
      EXPECT_TRUE(log.WaitUntilDone());
      return {log.Count("frames"), log.Count("frames_without_lines"), log.Value("message")};
    }

    ros::NodeHandle node;
    ros::Publisher imu = node.advertise<sensor_msgs::Imu>("/imu0", 1000);
    ros::Publisher points =
        node.advertise<sensor_msgs::PointCloud>("/feature_tracker/feature", 100);
    ros::Publisher lines =
        node.advertise<sensor_msgs::PointCloud>("/linefeature_tracker/linefeature", 100);
    EstimatorLog log;
    int image = 0;
  };

  static Feed* feed_;
};
Lines::Feed* Lines::feed_ = nullptr;

bool SaysPointsAlone(const std::string& message) {
  return message.find("points only") != std::string::npos;
}

TEST_F(Lines, ArePairedBeforeOrAfterTheirPoints) {
  for (const bool lines_first : {false, true}) {
    const Counts counts = Play(40, 0, lines_first);
    EXPECT_GE(counts.frames, 39);
    EXPECT_EQ(counts.without_lines, 0);
    EXPECT_FALSE(SaysPointsAlone(counts.message)) << counts.message;
  }
}

TEST_F(Lines, ArePairedIfTheyLag) {
  const Counts counts = Play(40, 2);
  EXPECT_LE(counts.without_lines, 2) << "the first two are those of images that had theirs";
  EXPECT_GE(counts.frames, 37);
}

TEST_F(Lines, MissingLinesDoNotStopPointsAndAreUsedAgain) {
  const Counts dead = Play(60, -1);
  EXPECT_GE(dead.frames, 60) << "some waited for their lines before";
  EXPECT_GE(dead.without_lines, 58);
  EXPECT_TRUE(SaysPointsAlone(dead.message)) << dead.message;

  const Counts back = Play(40, 0);
  EXPECT_GE(back.frames, 39);
  EXPECT_LE(back.without_lines, 5);
  EXPECT_FALSE(SaysPointsAlone(back.message)) << back.message;
}

TEST_F(Lines, LateLinesDoNotDelayPoints) {
  const Counts slow = Play(60, 8);
  EXPECT_GE(slow.frames, 59);
  EXPECT_TRUE(SaysPointsAlone(slow.message)) << slow.message;
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "lines_test");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
