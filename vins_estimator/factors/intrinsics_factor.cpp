// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/intrinsics_factor.h"

namespace plm_vins {
namespace {

using JacobianMap = Eigen::Map<Eigen::Matrix<double, 2, kIntrinsicsSize, Eigen::RowMajor>>;

}  // namespace

bool PointIntrinsicsFactor::Evaluate(double const* const* parameters, double* residuals,
                                     double** jacobians) const {
  const int block = factor_.num_blocks();
  if (!factor_.Evaluate(parameters, residuals, jacobians)) return false;
  Eigen::Map<Eigen::Vector2d>{residuals} -= factor_.weight() * shift_.At(parameters[block]);
  if (jacobians != nullptr && jacobians[block] != nullptr) {
    JacobianMap{jacobians[block]} = -factor_.weight() * shift_.d_xy_d_intrinsics;
  }
  return true;
}

bool LineIntrinsicsFactor::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const int block = factor_.num_blocks();
  const double* c = parameters[block];
  LineFactor shifted = factor_;
  shifted.set_segment(
      {factor_.segment().start + start_shift_.At(c), factor_.segment().end + end_shift_.At(c)});
  Eigen::Vector2d normal;
  if (!shifted.EvaluateWithNormal(parameters, residuals, jacobians, &normal)) return false;
  if (jacobians != nullptr && jacobians[block] != nullptr) {
    JacobianMap J(jacobians[block]);
    const Eigen::Vector2d& weights = factor_.weights();
    J.row(0) = weights[0] * normal.transpose() * start_shift_.d_xy_d_intrinsics;
    J.row(1) = weights[1] * normal.transpose() * end_shift_.d_xy_d_intrinsics;
  }
  return true;
}

}  // namespace plm_vins
