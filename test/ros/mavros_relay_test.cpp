// SPDX-License-Identifier: BSD-3-Clause
// Stands on both sides of the relay: an estimator, and mavros. Run by mavros_relay.test.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt8.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

// An estimator whose IMU has z down, is level and moves forward while it turns right.
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
    return images_.getNumSubscribers() == 2 && states_.getNumSubscribers() == 2;  // relays
  }

  // States at 100 Hz and images at 10 Hz, by their stamps, however slow this machine is.
  void Fly(double seconds, bool with_images) {
    for (int i = 0; i < 100 * seconds; ++i) {
      state_.header.stamp += ros::Duration(0.01);
      if (with_images && i % 10 == 0) images_.publish(state_);
      states_.publish(state_);
      ros::WallDuration(0.01).sleep();
      ros::spinOnce();
    }
    ros::WallDuration(0.3).sleep();  // for what is under way
    ros::spinOnce();
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
  FakeMavros(const std::string& relay, const std::string& topic)
      : odometry_(node_.subscribe(topic, 100, &FakeMavros::Add, this)),
        counter_(node_.subscribe(relay + "/reset_counter", 10, &FakeMavros::Count, this)) {}

  bool IsConnected() const {
    return odometry_.getNumPublishers() > 0 && counter_.getNumPublishers() > 0;
  }

  std::vector<nav_msgs::Odometry> messages;
  int reset_counter = -1;

 private:
  void Add(const nav_msgs::Odometry& message) { messages.push_back(message); }
  void Count(const std_msgs::UInt8& count) { reset_counter = count.data; }

  ros::NodeHandle node_;
  ros::Subscriber odometry_;
  ros::Subscriber counter_;
};

void WaitFor(const FakeEstimator& estimator, const FakeMavros& mavros) {
  for (int i = 0; i < 300 && !(estimator.IsConnected() && mavros.IsConnected()); ++i) {
    ros::WallDuration(0.1).sleep();
  }
}

TEST(MavrosRelay, SendsWhatMavrosWantsAsLongAsTheEstimateHolds) {
  FakeEstimator estimator;
  FakeMavros mavros("/mavros_relay", "/mavros/odometry/out");
  WaitFor(estimator, mavros);
  estimator.Fly(1.0, true);
  ASSERT_FALSE(mavros.messages.empty());
  EXPECT_EQ(mavros.reset_counter, 0);
  const nav_msgs::Odometry& sent = mavros.messages.back();
  EXPECT_EQ(sent.header.frame_id, "odom");
  EXPECT_EQ(sent.child_frame_id, "base_link");
  EXPECT_NEAR((estimator.newest() - sent.header.stamp).toSec(), 0, 0.05);
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
  EXPECT_NEAR(static_cast<double>(mavros.messages.size()), 60, 2);

  estimator.Fly(1.0, false);
  mavros.messages.clear();
  estimator.Fly(1.0, false);
  EXPECT_TRUE(mavros.messages.empty());

  estimator.Fly(1.0, true);
  EXPECT_FALSE(mavros.messages.empty());
  EXPECT_EQ(mavros.reset_counter, 1);
}

TEST(MavrosRelay, AsksTfWhereTheBaseIs) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "body";
  transform.child_frame_id = "base_link";
  transform.transform.translation.z = 0.5;
  transform.transform.rotation.w = 1;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  FakeEstimator estimator;
  FakeMavros mavros("/relay_with_tf", "/with_tf/odometry/out");
  WaitFor(estimator, mavros);
  estimator.Fly(1.0, true);
  EXPECT_TRUE(mavros.messages.empty());
  broadcaster.sendTransform(transform);
  estimator.Fly(3.0, true);
  ASSERT_FALSE(mavros.messages.empty());
  EXPECT_NEAR(mavros.messages.back().pose.pose.position.z, 2 - 0.5, 1e-9);  // z is down there
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "mavros_relay_test");
  ::testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
