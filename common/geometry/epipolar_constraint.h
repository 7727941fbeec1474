// SPDX-License-Identifier: BSD-3-Clause
// Epipolar constraint of a direction observed by two cameras, for the refinement of their relative
// pose.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plm_vins {

// Derivative of weight * t . (a x b), where a = R f0 and b = f1 are the observations in the frame
// of the second camera: by theta in R <- Exp(theta) R, then by eta in t <- t + basis * eta. The
// weight is held constant.
inline Eigen::Matrix<double, 5, 1> EpipolarGradient(double weight, const Eigen::Vector3d& a,
                                                    const Eigen::Vector3d& b,
                                                    const Eigen::Vector3d& t,
                                                    const Eigen::Matrix<double, 3, 2>& basis) {
  Eigen::Matrix<double, 5, 1> gradient;
  gradient.head<3>() = weight * a.cross(b.cross(t));
  gradient.tail<2>() = weight * basis.transpose() * a.cross(b);
  return gradient;
}

}  // namespace plm_vins
