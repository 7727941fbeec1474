// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/robot_base.h"

#include <ros/console.h>

#include "common/ros/geometry_conversion.h"

namespace plm_vins {

RobotBase::RobotBase(const std::string& body_frame, const std::string& base_frame)
    : body_frame_(body_frame),
      base_frame_(base_frame),
      listener_(std::make_unique<tf2_ros::TransformListener>(buffer_)) {}

std::optional<Rigid3d> RobotBase::Locate() {
  if (T_body_base_) return T_body_base_;
  if (!buffer_.canTransform(body_frame_, base_frame_, ros::Time(0))) {
    ROS_WARN_THROTTLE(5, "no tf from base_frame %s to %s yet; check that the robot publishes it",
                      base_frame_.c_str(), body_frame_.c_str());
    return std::nullopt;
  }
  const auto message = buffer_.lookupTransform(body_frame_, base_frame_, ros::Time(0));
  T_body_base_ = ToRigid(message.transform);
  listener_.reset();
  return T_body_base_;
}

}  // namespace plm_vins
