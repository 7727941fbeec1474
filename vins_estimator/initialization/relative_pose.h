// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "vins_estimator/initialization/tracks.h"

namespace plm_vins {

// The second camera C1 relative to the first C0; the length of the translation is not observable.
struct RelativePose {
  Eigen::Quaterniond R_C1_C0 = Eigen::Quaterniond::Identity();
  // Unit length: a point p_C0 is seen at R_C1_C0 p_C0 + s t_C1_C0, s > 0.
  Eigen::Vector3d t_C1_C0 = Eigen::Vector3d::Zero();
  // Inverse covariance of theta in Exp(theta) R_C1_C0, the translation not known [1/rad^2].
  Eigen::Matrix3d rotation_information = Eigen::Matrix3d::Zero();
  std::vector<bool> inliers;
  int num_inliers = 0;
};

// Epipolar geometry of two calibrated views: a robust least-squares fit of the Sampson distances,
// from the gyro's rotation, and, where many points contradict that, from the consensus of
// five-point hypotheses (deterministic); the better one is taken. The gyro's rotation, a few
// degrees uncertain, also decides between the solutions of a plane; the sign of the translation is
// the one that puts most points in front of both cameras. Where the camera only turned, the
// rotation is good and the translation arbitrary. `noise`: standard deviation of a normalised
// coordinate. Nothing, and the reason in words, where too few points agree.
std::optional<RelativePose> EstimateRelativePose(const std::vector<Correspondence>& correspondences,
                                                 const Eigen::Quaterniond& R_C1_C0_gyro,
                                                 double noise, std::string* reason);

// Median angle between the two rays of a point once the rotation is compensated [rad].
double MedianParallax(const std::vector<Correspondence>& correspondences,
                      const Eigen::Quaterniond& R_C1_C0);

}  // namespace plm_vins
