// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "common/geometry/rigid3.h"
#include "pose_graph/description/descriptor.h"
#include "pose_graph/geometry/level_transform.h"
#include "pose_graph/keyframes/odometry_frame.h"

namespace plm_vins {

// A corner of a keyframe. Single precision saves memory, since a map has very many.
struct DescribedCorner {
  int64_t track = -1;  // -1: detected for this keyframe only, not tracked
  int camera = 0;
  Eigen::Vector2f uv_px = Eigen::Vector2f::Zero();
  Eigen::Vector2f xy = Eigen::Vector2f::Zero();  // normalized, undistorted
  std::optional<Eigen::Vector3f> p_O;            // landmark position in O, if triangulated [m]
  Descriptor descriptor = {};
};

// The images of one time with pose and features, stored to recognize their place later.
struct Keyframe {
  int64_t t_ns = 0;
  int world = 0;    // number of the odometry's world O; each start of odometry begins a new one
  double path = 0;  // distance traveled since the start of O [m]
  Rigid3d T_O_B;
  Matrix4d covariance = Matrix4d::Zero();  // covariance of T_O_B as (x, y, z, yaw), by odometry
  std::vector<Rigid3d> T_B_C{Rigid3d()};   // by camera
  std::vector<DescribedCorner> corners;    // of all described cameras
  std::vector<TrackedSegment> segments;

  int cameras() const { return static_cast<int>(T_B_C.size()); }
  Rigid3d T_O_C(int camera) const { return T_O_B * T_B_C[camera]; }
  // The corners or segments in the image of one camera.
  std::vector<DescribedCorner> CornersIn(int camera) const;
  std::vector<TrackedSegment> SegmentsIn(int camera) const;
  // L has the body's position and the axes of O. Its heading is zero by definition, since a body
  // may have none: EuRoC's x axis points up.
  LevelTransform T_O_L() const { return {0, T_O_B.translation}; }
};

// Identifies an image of the map.
struct MapImage {
  int keyframe = -1;  // number
  int camera = 0;

  bool operator==(const MapImage& other) const {
    return keyframe == other.keyframe && camera == other.camera;
  }
  bool operator<(const MapImage& other) const {
    return std::tie(keyframe, camera) < std::tie(other.keyframe, other.camera);
  }
};

// Returns the numbers of the keyframes at most `radius` before and after `number` in the same
// world, including itself.
inline std::vector<int> NumbersAround(const std::vector<Keyframe>& keyframes, int number,
                                      int radius) {
  std::vector<int> numbers;
  const int end = std::min(number + radius + 1, static_cast<int>(keyframes.size()));
  for (int i = std::max(0, number - radius); i < end; ++i) {
    if (keyframes[i].world == keyframes[number].world) numbers.push_back(i);
  }
  return numbers;
}

}  // namespace plm_vins
