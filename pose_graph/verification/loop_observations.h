// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/features/placed_features.h"
#include "common/geometry/rigid3.h"
#include "common/measurements.h"
#include "pose_graph/geometry/level_transform.h"

namespace plm_vins {

// A landmark and its observation in an image.
struct SeenPoint {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();   // normalized
  int64_t track = -1;                             // landmark's track number in its world
};

// A camera pose, inverted once for many reprojection errors. G is a level frame (z up).
class Viewpoint {
 public:
  Viewpoint(const LevelTransform& T_O_G, const Eigen::Quaterniond& R_G_C)
      : T_G_O_(T_O_G.Inverse().ToRigid()), R_C_G_(R_G_C.conjugate()) {}

  // Reprojection error (normalized); infinite behind the camera.
  double Error(const SeenPoint& observation) const {
    const Eigen::Vector3d p_C = R_C_G_ * (T_G_O_ * observation.p_O);
    if (p_C.z() <= 0) return std::numeric_limits<double>::infinity();
    return (p_C.hnormalized() - observation.xy).norm();
  }

 private:
  Rigid3d T_G_O_;
  Eigen::Quaterniond R_C_G_;
};

// A 3-D line segment and its observation in an image.
struct SeenSegment {
  SpaceSegment line;
  LineObservation segment;
};

// Observations that connect two visits of a place. O1 is the odometry world of the earlier visit,
// O2 that of the later one.
struct LoopObservations {
  int earlier_camera = 0;
  int later_camera = 0;
  Rigid3d T_O1_C;                     // pose of the earlier camera
  Rigid3d T_O2_C;                     // pose of the later camera
  std::vector<SeenPoint> of_earlier;  // landmarks in O1, observed by the later camera
  std::vector<SeenPoint> of_later;    // landmarks in O2, observed by the earlier camera
  std::vector<SeenSegment> lines;     // in O1, observed by the later camera
};

}  // namespace plm_vins
