// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <optional>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Where the base of a robot is relative to the body (IMU), from the robot's own tf tree, in which
// the two are rigidly connected. For one thread.
class RobotBase {
 public:
  RobotBase(const std::string& body_frame, const std::string& base_frame);

  // The base in the body frame, looked up once. Until tf has it: nothing, with a rare warning.
  std::optional<Rigid3d> Locate();

 private:
  std::string body_frame_;
  std::string base_frame_;
  tf2_ros::Buffer buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;  // until it is known
  std::optional<Rigid3d> T_body_base_;
};

}  // namespace plm_vins
