// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "vins_estimator/geometry/plucker.h"

namespace plm_vins {

// The end points of a line in one image, normalised and undistorted. Only their distances from the
// projected line count: along the line they may be anywhere (aperture problem).
struct LineSegmentView {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
};

// Distances of both end points from the image of a line with this moment in the camera frame,
//   d = x~ . m / |(m_x, m_y)|   ([He2018], Eq. (20)), and their derivative by the moment.
// False where the line has no image: it passes through the camera or lies at infinity behind.
bool EndPointDistances(const LineSegmentView& view, const Eigen::Vector3d& moment_C,
                       Eigen::Vector2d* distances,
                       Eigen::Matrix<double, 2, 3>* d_distances_d_moment);

// A line, given in its host camera, seen from another frame:
//   r = weight * EndPointDistances(view, moment of T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C L_Ch)
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), line (5). Jacobians follow
// factors/manifolds.h.
class LineFactor final : public ceres::SizedCostFunction<2, 7, 7, 7, kLineSize> {
 public:
  // `weight`: focal length over the standard deviation of an end point across the line, in pixels.
  LineFactor(const LineSegmentView& view, double weight) : view_(view), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  LineSegmentView view_;
  double weight_;
};

// The host's own view: r = weight * EndPointDistances(view, moment of L_Ch). Block: line (5).
class LineHostFactor final : public ceres::SizedCostFunction<2, kLineSize> {
 public:
  LineHostFactor(const LineSegmentView& view, double weight) : view_(view), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  LineSegmentView view_;
  double weight_;
};

}  // namespace plm_vins
