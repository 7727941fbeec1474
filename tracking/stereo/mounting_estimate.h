// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// One point as both cameras of a pair see it: normalised, undistorted image coordinates.
struct StereoMatch {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // in the first camera C
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // d(xy)/dt [1/s]; zero where unknown
  Eigen::Vector2d xy_C1 = Eigen::Vector2d::Zero();     // in the second camera C1
};

// How the second camera is really mounted and timed, as far as the epipolar constraint of matched
// points tells: its rotation, the direction of the baseline, and by how much it exposes later than
// the first. Linear least squares about the stated mounting with Gaussian priors, robust against
// wrong matches; old images count less and less. A matcher searches along its epipolar curves and
// compares matches with it.
class MountingEstimate {
 public:
  // `focal_length` [px] converts normalised errors to pixels.
  MountingEstimate(const Rigid3d& stated_T_C1_C, double focal_length);

  // Takes in the matches of one image.
  void Update(const std::vector<StereoMatch>& matches);

  // Whether the match is as close to its epipolar curve as the estimate is known.
  bool Accepts(const StereoMatch& match) const;

  // Distance from the epipolar curve [px] by the stated mounting, and by the estimated one.
  double StatedError_px(const StereoMatch& match) const;
  double Error_px(const StereoMatch& match) const;

  // Returns where the second camera would see the point if it exposed with the first one.
  Eigen::Vector2d WithoutDelay(const StereoMatch& match) const;

  Rigid3d T_C1_C() const;
  // The rotation about the stated mounting [rad], in C1.
  Eigen::Vector3d rotation() const { return state_.head<3>(); }
  double delay() const { return state_[kDelay]; }  // positive: exposes later than the first [s]
  // Largest standard deviation of where the epipolar curves lie, from the mounting alone [px].
  double Deviation_px() const;

 private:
  static constexpr int kDelay = 5;
  static constexpr int kSize =
      6;  // rotation, direction of the baseline in its tangent basis, delay
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  struct Linear {
    double error = 0;  // by the stated mounting [px]
    Vector gradient = Vector::Zero();
  };
  Linear Linearize(const StereoMatch& match) const;
  Eigen::Vector2d Velocity_C1(const StereoMatch& match) const;

  Rigid3d stated_T_C1_C_;
  double focal_length_;
  Eigen::Vector3d baseline_direction_;
  Eigen::Matrix<double, 3, 2> baseline_tangent_;
  Matrix information_ = Matrix::Zero();  // of the images before, without the prior
  Vector gradient_ = Vector::Zero();     // the same, at the stated mounting
  Vector state_ = Vector::Zero();        // relative to the stated mounting
  Matrix prior_;                         // information
  Matrix covariance_;
};

}  // namespace plm_vins
