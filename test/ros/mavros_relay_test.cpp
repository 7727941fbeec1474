// SPDX-License-Identifier: BSD-3-Clause
// Takes the places of the estimator and of mavros on both sides of the relay. Run by
// mavros_relay.test.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/UInt8.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "test/ros/estimator_log.h"

namespace {

using plm_vins::testing::SpinUntil;

constexpr double kPatience = 10;  // [s]

// An estimator whose IMU has z down, is level and moves forward while it rotates to the right.
class FakeEstimator {
 public:
  FakeEstimator() {
    state_.header.stamp = ros::Time::now();
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

  ros::Time newest() const { return state_.header.stamp; }

  bool IsConnected() const {
    return images_.getNumSubscribers() == 1 && states_.getNumSubscribers() == 1;
  }

  // Publishes states at 100 Hz and images at 10 Hz by timestamp, however slow the machine is.
  void Fly(double seconds, bool with_images) {
    for (int i = 0; i < 100 * seconds; ++i) {
      state_.header.stamp += ros::Duration(0.01);
      if (with_images && i % 10 == 0) images_.publish(state_);
      states_.publish(state_);
      ros::WallDuration(0.01).sleep();
      ros::spinOnce();
    }
  }

  // Publishes neither states nor images.
  void Pause(double seconds) {
    state_.header.stamp += ros::Duration(seconds);
    ros::WallDuration(seconds).sleep();
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

  // Waits until the estimator's last message has arrived, and so all earlier ones.
  bool WaitForNewest(const FakeEstimator& estimator) const {
    return SpinUntil(kPatience, [&] {
      return !messages.empty() &&
             estimator.newest() - messages.back().header.stamp < ros::Duration(0.05);
    });
  }

  bool WaitForCounter(int count) const {
    return SpinUntil(kPatience, [&] { return reset_counter == count; });
  }

  // Counts messages with timestamps after `begin` and up to `end`.
  auto CountWithin(const ros::Time& begin, const ros::Time& end) const {
    return std::count_if(messages.begin(), messages.end(), [&](const nav_msgs::Odometry& message) {
      return message.header.stamp > begin && message.header.stamp <= end;
    });
  }

  std::vector<nav_msgs::Odometry> messages;
  int reset_counter = -1;

 private:
  void Add(const nav_msgs::Odometry& message) { messages.push_back(message); }
  void Count(const std_msgs::UInt8& count) { reset_counter = count.data; }

  ros::NodeHandle node_;
  ros::Subscriber odometry_ = node_.subscribe("/mavros/odometry/out", 1000, &FakeMavros::Add, this);
  ros::Subscriber counter_ =
      node_.subscribe("/mavros_relay/reset_counter", 10, &FakeMavros::Count, this);
};

void WaitFor(const FakeEstimator& estimator, const FakeMavros& mavros) {
  for (int i = 0; i < 300 && !(estimator.IsConnected() && mavros.IsConnected()); ++i) {
    ros::WallDuration(0.1).sleep();
  }
}

TEST(MavrosRelay, RelaysWhileTheEstimateIsUsable) {
  std::string log;
  const ros::Subscriber log_subscriber = ros::NodeHandle().subscribe<rosgraph_msgs::Log>(
      "/rosout", 1000, [&](const rosgraph_msgs::LogConstPtr& line) {
        if (line->name == "/mavros_relay") log += line->msg + "\n";
      });
  FakeEstimator estimator;
  FakeMavros mavros;
  WaitFor(estimator, mavros);
  estimator.Fly(1.0, true);
  EXPECT_TRUE(mavros.messages.empty());  // tf does not have the base yet
  // An IMU with z down, 0.1 m ahead of the base.
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "body";
  transform.child_frame_id = "base_link";
  transform.transform.translation.x = -0.1;
  transform.transform.rotation.x = 1;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform(transform);
  for (int i = 0; i < 10 && mavros.messages.empty(); ++i) estimator.Fly(1.0, true);
  ASSERT_TRUE(mavros.WaitForNewest(estimator));
  EXPECT_TRUE(mavros.WaitForCounter(0));
  const nav_msgs::Odometry sent = mavros.messages.back();
  EXPECT_EQ(sent.header.frame_id, "odom");
  EXPECT_EQ(sent.child_frame_id, "base_link");
  EXPECT_NEAR(sent.pose.pose.position.x, -0.1, 1e-9);
  EXPECT_NEAR(sent.pose.pose.position.z, 2, 1e-9);
  EXPECT_NEAR(std::abs(sent.pose.pose.orientation.w), 1, 1e-9);
  EXPECT_NEAR(sent.twist.twist.linear.x, 3, 1e-9);
  EXPECT_NEAR(sent.twist.twist.linear.y, 0.05, 1e-9);
  EXPECT_NEAR(sent.twist.twist.angular.z, -0.5, 1e-9);
  EXPECT_NEAR(sent.pose.covariance[0], 0.01, 1e-9);
  // Errors of heading about z and pitch about y move the base sideways and up.
  EXPECT_NEAR(sent.pose.covariance[7], 0.02 + 0.01 * 0.06, 1e-9);
  EXPECT_NEAR(sent.pose.covariance[14], 0.03 + 0.01 * 0.05, 1e-9);
  EXPECT_NEAR(sent.twist.covariance[35], 0.6, 1e-9);

  const ros::Time begin = estimator.newest();
  estimator.Fly(2.0, true);
  ASSERT_TRUE(mavros.WaitForNewest(estimator));
  EXPECT_NEAR(static_cast<double>(mavros.CountWithin(begin, estimator.newest())), 60, 2);

  estimator.Fly(1.0, false);
  const ros::Time unsupported = estimator.newest();
  estimator.Fly(1.0, false);
  const ros::Time end = estimator.newest();
  estimator.Fly(1.0, true);
  ASSERT_TRUE(mavros.WaitForNewest(estimator));
  EXPECT_EQ(mavros.CountWithin(unsupported, end), 0);
  EXPECT_TRUE(mavros.WaitForCounter(1)) << mavros.reset_counter;

  estimator.Pause(2.0);
  EXPECT_TRUE(SpinUntil(kPatience, [&] {
    return log.find("not relayed: no usable state arrives on vins_estimator/imu_propagate") !=
           std::string::npos;
  })) << log;
  estimator.Fly(1.0, true);
  ASSERT_TRUE(mavros.WaitForNewest(estimator));
  EXPECT_TRUE(mavros.WaitForCounter(2)) << mavros.reset_counter;
}

}  // namespace
