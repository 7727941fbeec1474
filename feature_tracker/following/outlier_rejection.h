// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace plm_vins {

// Unit rays of a point in two images, each in its camera frame.
struct RayPair {
  Eigen::Vector3d ray_then;
  Eigen::Vector3d ray_now;
};

// Returns which pairs are inliers of one rigid camera motion, p_C1 = R_now_then p_C0 + t: their
// angular epipolar error is at most `threshold` [rad].
//
// `R_now_then` is the initial rotation (integrated from the gyroscope, so wrong by its bias); if
// nullopt, a rotation-only fit replaces it. RANSAC with a fixed seed draws two pairs for the
// translation direction, or five for rotation and translation if no rotation is given. The best
// hypothesis is refined robustly over all pairs. Angular errors make the test valid for any field
// of view. Without parallax (standstill, pure rotation) every translation is consistent and all
// true pairs are inliers. Returns all pairs as inliers if there are fewer than eight.
std::vector<bool> FindEpipolarInliers(const std::vector<RayPair>& pairs,
                                      const std::optional<Eigen::Quaterniond>& R_now_then,
                                      double threshold);

}  // namespace plm_vins
