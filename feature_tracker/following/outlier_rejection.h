// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace plm_vins {

// A direction seen in two images, of unit length, each in its camera frame.
struct RayPair {
  Eigen::Vector3d ray_C0;
  Eigen::Vector3d ray_C1;
};

// Which pairs agree with one rigid motion of the camera, p_C1 = R_C1_C0 p_C0 + t: the epipolar
// error of a good one is at most `threshold` [rad].
//
// `R_C1_C0` is a first guess (from the gyro, so off by its bias); without it the rotation that
// explains the pairs best stands in. RANSAC, with a generator of its own of fixed seed, draws two
// pairs for a translation direction, or five for that and the rotation where none is given; the
// best geometry is then refined over all pairs, robustly. Angles instead of distances in a plane
// make it valid for any field of view. Without parallax (standstill, pure rotation) every
// translation fits and all good pairs stay. All pairs are returned as good where there are fewer
// than eight.
std::vector<bool> FindEpipolarInliers(const std::vector<RayPair>& pairs,
                                      const std::optional<Eigen::Quaterniond>& R_C1_C0,
                                      double threshold);

}  // namespace plm_vins
