// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "pose_graph/description/descriptor.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// A corner as it is remembered. In single precision: a map has very many.
struct DescribedCorner {
  int64_t track = -1;  // -1: found for this keyframe alone
  Eigen::Vector2f uv_px = Eigen::Vector2f::Zero();
  Eigen::Vector2f xy = Eigen::Vector2f::Zero();  // normalised, undistorted
  std::optional<Eigen::Vector3f> p_O;            // place in O, where known [m]
  Descriptor descriptor = {};
};

// An image that is remembered for when the camera comes back.
struct Keyframe {
  int64_t t_ns = 0;
  int world = 0;    // names the odometry's world O: one for each start of the odometry
  double path = 0;  // length of the way from the start of O [m]
  Rigid3d T_O_B;
  Matrix4d covariance = Matrix4d::Zero();  // of (x, y, z, yaw) of T_O_B, as odometry states it
  Rigid3d T_B_C;
  std::optional<Eigen::Quaterniond> R_O_Manhattan;
  std::vector<DescribedCorner> corners;
  std::vector<TrackedSegment> segments;

  Rigid3d T_O_C() const { return T_O_B * T_B_C; }
  // L: at the body's place, with the axes of O. Its heading is zero by definition, as a body may
  // have none: that of EuRoC flies with its x axis up.
  LevelTransform T_O_L() const { return {0, T_O_B.translation}; }
};

}  // namespace plm_vins
