// SPDX-License-Identifier: BSD-3-Clause
// Stands on both sides of the relay: an estimator, and mavros. Run by mavros_relay.test.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt8.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

// An estimator whose IMU has z down, is level and moves forward while it turns right.
class FakeEstimator {
 public:
  FakeEstimator() {
    state_.header.frame_id = "world";
    state_.child_frame_id = "body";
    state_.pose.pose.position.z = 2;
    state_.pose.pose.orientation.x = 1;
    state_.twist.twist.linear.x = 3;
    state_.twist.twist.angular.z = 0.5;
    for (int i = 0; i < 6; ++i) {
      state_.pose.covariance[7 * i] = 0.01 * (i + 1);
      state_.twist.covariance[7 * i] = 0.1 * (i + 1);
    }
  }

  bool IsConnected() const {
    return images_.getNumSubscribers() > 0 && states_.getNumSubscribers() > 0;
  }

  // States at 100 Hz and images at 10 Hz, both in real time.
  void Fly(double seconds, bool with_images) {
    for (int i = 0; i < 100 * seconds; ++i) {
      state_.header.stamp = ros::Time::now();
      if (with_images && i % 10 == 0) images_.publish(state_);
      states_.publish(state_);
      ros::WallDuration(0.01).sleep();
      ros::spinOnce();
    }
  }

 private:
  ros::NodeHandle node_;
  ros::Publisher images_ = node_.advertise<nav_msgs::Odometry>("/vins_estimator/odometry", 100);
  ros::Publisher states_ =
      node_.advertise<nav_msgs::Odometry>("/vins_estimator/imu_propagate", 100);
  nav_msgs::Odometry state_;
};

class FakeMavros {
 public:
  bool IsConnected() const {
    return odometry_.getNumPublishers() > 0 && counter_.getNumPublishers() > 0;
  }

  std::vector<nav_msgs::Odometry> messages;
  int reset_counter = -1;

 private:
  void Add(const nav_msgs::Odometry& message) { messages.push_back(message); }
  void Count(const std_msgs::UInt8& count) { reset_counter = count.data; }

  ros::NodeHandle node_;
  ros::Subscriber odometry_ = node_.subscribe("/mavros/odometry/out", 100, &FakeMavros::Add, this);
  ros::Subscriber counter_ =
      node_.subscribe("/mavros_relay/reset_counter", 10, &FakeMavros::Count, this);
};

TEST(MavrosRelay, SendsWhatMavrosWantsAsLongAsTheEstimateHolds) {
  FakeEstimator estimator;
  FakeMavros mavros;
  for (int i = 0; i < 300 && !(estimator.IsConnected() && mavros.IsConnected()); ++i) {
    ros::WallDuration(0.1).sleep();
  }
  estimator.Fly(1.0, true);
  ASSERT_FALSE(mavros.messages.empty());
  EXPECT_EQ(mavros.reset_counter, 0);
  const nav_msgs::Odometry& sent = mavros.messages.back();
  EXPECT_EQ(sent.header.frame_id, "odom");
  EXPECT_EQ(sent.child_frame_id, "base_link");
  EXPECT_NEAR((ros::Time::now() - sent.header.stamp).toSec(), 0, 0.5);
  EXPECT_NEAR(sent.pose.pose.position.x, -0.1, 1e-9);
  EXPECT_NEAR(sent.pose.pose.position.z, 2, 1e-9);
  EXPECT_NEAR(std::abs(sent.pose.pose.orientation.w), 1, 1e-9);
  EXPECT_NEAR(sent.twist.twist.linear.x, 3, 1e-9);
  EXPECT_NEAR(sent.twist.twist.linear.y, 0.05, 1e-9);
  EXPECT_NEAR(sent.twist.twist.angular.z, -0.5, 1e-9);
  EXPECT_NEAR(sent.pose.covariance[0], 0.01, 1e-9);
  // Heading along z and pitch about y move the base across and up.
  EXPECT_NEAR(sent.pose.covariance[7], 0.02 + 0.01 * 0.06, 1e-9);
  EXPECT_NEAR(sent.pose.covariance[14], 0.03 + 0.01 * 0.05, 1e-9);
  EXPECT_NEAR(sent.twist.covariance[35], 0.6, 1e-9);

  mavros.messages.clear();
  estimator.Fly(2.0, true);
  EXPECT_NEAR(static_cast<double>(mavros.messages.size()), 60, 15);

  estimator.Fly(1.0, false);
  mavros.messages.clear();
  estimator.Fly(1.0, false);
  EXPECT_TRUE(mavros.messages.empty());

  estimator.Fly(1.0, true);
  EXPECT_FALSE(mavros.messages.empty());
  EXPECT_EQ(mavros.reset_counter, 1);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "mavros_relay_test");
  ::testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
