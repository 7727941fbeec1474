// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// One point as both cameras of a pair observe it, in normalized, undistorted coordinates.
struct StereoMatch {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // in the first camera C
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // d(xy)/dt [1/s]; zero if unknown
  Eigen::Vector2d xy_S = Eigen::Vector2d::Zero();      // in the second camera S
};

// Estimates the actual extrinsics and timing of the second camera from the epipolar constraint of
// matched points: its rotation, the direction of the baseline, the delay of its exposure after that
// of the first camera, and the error of its focal length against that of the first. Linear least
// squares about the stated extrinsics with Gaussian priors, robust against wrong matches; old
// images are forgotten gradually. A matcher searches along the epipolar curves of this estimate and
// gates its matches by them.
class ExtrinsicsEstimate {
 public:
  // `focal_length` [px] converts normalized errors to pixels.
  ExtrinsicsEstimate(const Rigid3d& stated_T_S_C, double focal_length);

  // Updates the estimate with the matches of one image.
  void Update(const std::vector<StereoMatch>& matches);

  // Returns whether the match is within three standard deviations of its epipolar curve.
  bool Accepts(const StereoMatch& match) const;

  // Distance from the epipolar curve [px], of the stated and of the estimated extrinsics.
  double StatedError(const StereoMatch& match) const;
  double Error(const StereoMatch& match) const;

  // Returns the point in the second camera as if both cameras had exposed at the same time.
  Eigen::Vector2d WithoutDelay(const StereoMatch& match) const;

  Rigid3d T_S_C() const;
  // Rotation relative to the stated extrinsics [rad], in S.
  Eigen::Vector3d rotation() const { return state_.head<3>(); }
  double delay() const { return state_[kDelay]; }  // positive: exposes later than the first [s]
  // By how much its focal length is configured too long, relative to that of the first camera, if
  // the error is certain and matters; otherwise 0.
  double zoom() const;
  // Standard deviation of Error() due to the uncertain extrinsics and delay, and to the error of
  // the focal length, which T_S_C() cannot express [px].
  double Deviation(const StereoMatch& match) const;

 private:
  // Rotation, direction of the baseline in its tangent basis, delay, focal length.
  static constexpr int kDelay = 5, kZoom = 6, kSize = 7;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  struct Linear {
    double error = 0;  // error of the stated extrinsics [px]
    Vector gradient = Vector::Zero();
  };
  Linear Linearize(const StereoMatch& match) const;
  double Variance(const Linear& linear) const {
    return linear.gradient.dot(covariance_ * linear.gradient);
  }
  Eigen::Vector2d VelocityInSecond(const StereoMatch& match) const;

  Rigid3d stated_T_S_C_;
  double focal_length_;
  Eigen::Vector3d baseline_direction_;
  Eigen::Matrix<double, 3, 2> baseline_tangent_;
  Matrix information_ = Matrix::Zero();  // information of previous images, without the prior
  Vector gradient_ = Vector::Zero();     // gradient of these images, at the stated extrinsics
  Vector state_ = Vector::Zero();        // relative to the stated extrinsics
  Matrix prior_;                         // information
  Matrix covariance_;
};

}  // namespace plm_vins
