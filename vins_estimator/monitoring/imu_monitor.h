// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace plm_vins {

// Compares the IMU's motion up to each image with the camera's, and decides how far the IMU can be
// trusted. As long as both agree it has no effect. Otherwise it distinguishes:
//
//  - Abrupt contradictions, by one image or by several in a row: a bias may have stepped, and the
//    biases are set free in the newest interval.
//  - Persistent contradictions (jittering timestamps, missing samples): the assumed IMU noise is
//    scaled up accordingly.
//  - Apparent noise whose rotation has the same direction in each image: a gyroscope bias has
//    stepped by too little for an abrupt contradiction. It is set free, and the noise scale is
//    reset.
class ImuMonitor {
 public:
  // Evidence from the newest image after the optimization.
  struct Evidence {
    int64_t t_ns = 0;
    // Squared Mahalanobis distance of the IMU residual in the newest interval. The camera
    // constrains the six degrees of freedom of a pose, so its mean is at most six.
    double chi_square = 0;
    int points = 0;                                           // known points in the newest image
    int contradicted = 0;                                     // outliers among them
    Eigen::Vector3d turn_residual = Eigen::Vector3d::Zero();  // camera minus gyroscope [rad]
  };

  // Returns the factor on the noise variance if the newest interval must be re-weighted with free
  // biases, otherwise nullopt.
  std::optional<double> Add(const Evidence& evidence);

  // Returns the factor on the noise variance in the next interval; 1 if the noise is correct.
  double noise_scale() const;

 private:
  void FollowNoise(double chi_square);
  void FollowTurn(const Eigen::Vector3d& turn_residual);
  bool NoiseHasOneDirection() const;

  double followed_scale_ = 1;
  double excess_ = 0;                  // accumulated excess of chi_square over its normal value
  std::optional<int64_t> doubted_ns_;  // last time the biases were set free
  // Exponentially forgetting sums of residual rotations, of their squares, and of ones.
  Eigen::Vector3d turns_ = Eigen::Vector3d::Zero();
  double squared_turns_ = 0, images_ = 0;
};

}  // namespace plm_vins
