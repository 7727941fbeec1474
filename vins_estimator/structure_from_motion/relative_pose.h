// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/structure_from_motion/tracks.h"

namespace plm_vins {

// Pose of the camera now relative to that of an earlier view, "then"; the length of the translation
// is unobservable.
struct RelativePose {
  Eigen::Quaterniond R_now_then = Eigen::Quaterniond::Identity();
  // Unit vector: a point p_then is observed at R_now_then p_then + s t_now_then, s > 0.
  Eigen::Vector3d t_now_then = Eigen::Vector3d::Zero();
  // Inverse covariance of theta in Exp(theta) R_now_then, with the translation marginalized
  // [1/rad^2].
  Eigen::Matrix3d rotation_information = Eigen::Matrix3d::Zero();
  std::vector<bool> inliers;
  int num_inliers = 0;
};

// Estimates the epipolar geometry of two calibrated views by a robust least-squares fit of the
// Sampson distances. It starts from the gyroscope's rotation and, if that leaves many outliers,
// also from a five-point RANSAC (deterministic); the better fit is returned. The gyroscope's
// rotation, uncertain by a few degrees, also selects one of the solutions of a planar scene; the
// sign of the translation is the one that puts most points in front of both cameras. Under pure
// rotation, the rotation is accurate and the translation arbitrary. `noise` is the standard
// deviation of a normalized coordinate. Returns nullopt, with the reason, if there are too few
// inliers.
std::optional<RelativePose> EstimateRelativePose(const std::vector<Correspondence>& correspondences,
                                                 const Eigen::Quaterniond& R_now_then_gyro,
                                                 double noise, std::string* reason);

// Returns the median angle between the two rays of a point after compensation of the rotation
// [rad].
double MedianParallax(const std::vector<Correspondence>& correspondences,
                      const Eigen::Quaterniond& R_now_then);

}  // namespace plm_vins
