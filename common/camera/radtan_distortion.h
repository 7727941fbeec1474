// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace plm_vins {

// Radial and tangential distortion of an image plane, as defined by OpenCV with k1, k2, p1, p2:
//   x_d = x (1 + k1 r^2 + k2 r^4) + 2 p1 x y + p2 (r^2 + 2 x^2)
//   y_d = y (1 + k1 r^2 + k2 r^4) + p1 (r^2 + 2 y^2) + 2 p2 x y
// The polynomial may fold the plane back onto itself at some radius. Both directions reject points
// at or beyond the fold, so that each is the exact inverse of the other.
class RadtanDistortion {
 public:
  explicit RadtanDistortion(const Eigen::Vector4d& k1_k2_p1_p2);

  std::optional<Eigen::Vector2d> Distort(const Eigen::Vector2d& point,
                                         Eigen::Matrix2d* d_distorted_d_point) const;

  // The Jacobian is d_point_d_distorted.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& distorted,
                                           Eigen::Matrix2d* d_point_d_distorted) const;

  // Derivative of the distorted point by k1, k2, p1, p2, in which it is linear.
  static Eigen::Matrix<double, 2, 4> DistortedByCoefficients(const Eigen::Vector2d& point);

 private:
  double k1_, k2_, p1_, p2_;
  double max_radius_squared_;  // the radial part increases up to here
};

}  // namespace plm_vins
