// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace plm_vins {

// Compares what the IMU says of the motion to each image with what the camera shows, and says how
// far the IMU can be trusted. Where both fit, it says nothing, and nothing changes.
//
//  - Images that contradict at once, or several in a row that contradict by less: a bias may have
//    stepped, and the biases are set free in the newest interval.
//  - Contradictions that go on (stamps that jitter, samples that are missing): the IMU counts as
//    noisier by what they show.
//  - What counts as noise, but turns the same way image after image, is a bias of the gyro that
//    stepped by too little to contradict at once: it is set free, and the noise is forgotten.
class ImuMonitor {
 public:
  // What the newest image shows after the optimisation.
  struct Evidence {
    int64_t t_ns = 0;
    // Squared residual of the IMU term of the newest interval, in standard deviations. The camera
    // tells the six degrees of freedom of a pose, so that its mean is six at most.
    double chi_square = 0;
    int points = 0;                                           // known points in the newest image
    int contradicted = 0;                                     // of them: not where they should be
    Eigen::Vector3d turn_residual = Eigen::Vector3d::Zero();  // beyond the gyro's [rad]
  };

  // Where the newest interval is to be weighed anew, with free biases: by how much to scale the
  // variance of its noise.
  std::optional<double> Add(const Evidence& evidence);

  // By how much to scale it in the next interval; 1 where the configured noise fits.
  double noise_scale() const;

 private:
  void FollowNoise(double chi_square);
  void FollowTurn(const Eigen::Vector3d& turn_residual);
  bool NoiseHasOneDirection() const;

  double followed_scale_ = 1;
  double excess_ = 0;                  // of chi_square over what is normal, added up
  std::optional<int64_t> doubted_ns_;  // when the biases were last set free
  // Sums that forget: of residual turns, of their squares, and of ones.
  Eigen::Vector3d turns_ = Eigen::Vector3d::Zero();
  double squared_turns_ = 0, images_ = 0;
};

}  // namespace plm_vins
