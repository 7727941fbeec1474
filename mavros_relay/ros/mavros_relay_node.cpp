// SPDX-License-Identifier: BSD-3-Clause
// Relays the estimate to an autopilot through mavros; see docs/px4.md.
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt8.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/config/config_checks.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/node_setup.h"
#include "common/ros/parameter.h"
#include "common/ros/robot_base.h"
#include "mavros_relay/body_odometry.h"
#include "mavros_relay/relay_gate.h"

namespace plm_vins {
namespace {

constexpr double kRate = 30;      // of the relayed states, unless ~rate is set [Hz]
constexpr double kSilence = 1.0;  // wall time without states that counts as silence [s]

BodyOdometry ToBodyOdometry(const nav_msgs::Odometry& message) {
  const auto& twist = message.twist.twist;
  BodyOdometry odometry;
  odometry.T_W_B = ToRigid(message.pose.pose);
  odometry.v_B = {twist.linear.x, twist.linear.y, twist.linear.z};
  odometry.omega_B = {twist.angular.x, twist.angular.y, twist.angular.z};
  odometry.pose_covariance = Eigen::Map<const RowMajor6d>(message.pose.covariance.data());
  odometry.twist_covariance = Eigen::Map<const RowMajor6d>(message.twist.covariance.data());
  return odometry;
}

nav_msgs::Odometry ToMessage(const BodyOdometry& odometry) {
  nav_msgs::Odometry message;
  message.pose.pose = ToPose(odometry.T_W_B);
  message.twist.twist.linear = ToVector3(odometry.v_B);
  message.twist.twist.angular = ToVector3(odometry.omega_B);
  Eigen::Map<RowMajor6d>(message.pose.covariance.data()) = odometry.pose_covariance;
  Eigen::Map<RowMajor6d>(message.twist.covariance.data()) = odometry.twist_covariance;
  return message;
}

// Parameters: ~rate [Hz] of RelayGate; ~odom_frame and ~base_frame, names in the tf tree of mavros.
// tf has the pose of the base in the body. ~reset_counter (latched) counts, modulo 256, the
// interruptions after which relaying resumed.
class MavrosRelayNode {
 public:
  MavrosRelayNode();

 private:
  void AddImage(const nav_msgs::Odometry&) { gate_.AddImage(); }
  void AddState(const nav_msgs::Odometry& odometry);
  void ReportStop(const char* why);
  void ReportGoingOn();
  std::string ReadFrame(const std::string& parameter, const std::string& otherwise) const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  const std::string odom_frame_ = ReadFrame("odom_frame", "odom");
  const std::string base_frame_ = ReadFrame("base_frame", "base_link");
  RelayGate gate_{FindParameter<double>(private_node_, "rate").value_or(kRate)};
  bool is_relayed_ = false;                          // last reported state
  ros::WallTime last_state_ = ros::WallTime::now();  // arrival of the last valid state
  std::optional<RobotBase> base_;                    // set by the first state, which names the body
  ros::Publisher publisher_ = node_.advertise<nav_msgs::Odometry>("mavros/odometry/out", 10);
  ros::Publisher counter_ = private_node_.advertise<std_msgs::UInt8>("reset_counter", 1, true);
  ros::Subscriber images_;
  ros::Subscriber states_;
  ros::WallTimer silence_timer_;
};

MavrosRelayNode::MavrosRelayNode() {
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  counter_.publish(std_msgs::UInt8());
  images_ =
      node_.subscribe("vins_estimator/odometry", 100, &MavrosRelayNode::AddImage, this, no_delay);
  states_ = node_.subscribe("vins_estimator/imu_propagate", 100, &MavrosRelayNode::AddState, this,
                            no_delay);
  silence_timer_ =
      node_.createWallTimer(ros::WallDuration(0.5 * kSilence), [this](const ros::WallTimerEvent&) {
        const double silence = (ros::WallTime::now() - last_state_).toSec();
        if (silence > kSilence) {
          ReportStop("no usable state arrives on vins_estimator/imu_propagate");
        }
      });
}

std::string MavrosRelayNode::ReadFrame(const std::string& parameter,
                                       const std::string& otherwise) const {
  auto frame = FindParameter<std::string>(private_node_, parameter).value_or(otherwise);
  if (const auto problem = CheckFrameName(frame)) {
    throw std::runtime_error("parameter " + private_node_.resolveName(parameter) + ": \"" + frame +
                             "\" " + *problem);
  }
  return frame;
}

void MavrosRelayNode::AddState(const nav_msgs::Odometry& odometry) {
  const BodyOdometry body = ToBodyOdometry(odometry);
  if (!base_) base_.emplace(odometry.child_frame_id, base_frame_);
  const std::optional<Rigid3d> T_body_base = base_->Locate();
  if (!T_body_base || !body.IsUsable()) return;
  last_state_ = ros::WallTime::now();
  const bool passes = gate_.Pass(ToNanoseconds(odometry.header.stamp));
  if (gate_.is_interrupted()) {
    ReportStop("the input has a gap, or no recent image supports it");
  } else {
    ReportGoingOn();
  }
  if (!passes) return;
  nav_msgs::Odometry message = ToMessage(MoveTo(*T_body_base, body));
  message.header.stamp = odometry.header.stamp;
  message.header.frame_id = odom_frame_;
  message.child_frame_id = base_frame_;
  publisher_.publish(message);
}

void MavrosRelayNode::ReportStop(const char* why) {
  if (!is_relayed_) return;
  is_relayed_ = false;
  ROS_WARN("the estimate is not relayed: %s", why);
}

void MavrosRelayNode::ReportGoingOn() {
  if (is_relayed_) return;
  is_relayed_ = true;
  std_msgs::UInt8 count;
  count.data = static_cast<uint8_t>(gate_.resets());
  counter_.publish(count);
  ROS_INFO("the estimate is relayed, reset counter %d", count.data);
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "mavros_relay", [] {
    plm_vins::MavrosRelayNode node;
    plm_vins::Spin();
  });
}
