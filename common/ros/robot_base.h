// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <optional>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Looks up the pose of a robot's base relative to the body (IMU) in the robot's own tf tree, in
// which both are rigidly connected. Not thread-safe.
class RobotBase {
 public:
  RobotBase(const std::string& body_frame, const std::string& base_frame);

  // Returns the pose of the base in the body frame, which is looked up once. Until tf has it,
  // returns nullopt and warns rarely.
  std::optional<Rigid3d> Locate();

 private:
  std::string body_frame_;
  std::string base_frame_;
  tf2_ros::Buffer buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;  // until the pose is known
  std::optional<Rigid3d> T_body_base_;
};

}  // namespace plm_vins
