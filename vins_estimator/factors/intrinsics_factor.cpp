// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/intrinsics_factor.h"

#include <utility>

#include "vins_estimator/factors/line_factor.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;
using JacobianMap = Eigen::Map<Eigen::Matrix<double, 2, kIntrinsicsSize, Eigen::RowMajor>>;

}  // namespace

PointIntrinsicsFactor::PointIntrinsicsFactor(std::unique_ptr<const ceres::CostFunction> factor,
                                             const RayShift& shift, double weight)
    : factor_(std::move(factor)), shift_(shift), weight_(weight) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = factor_->parameter_block_sizes();
  mutable_parameter_block_sizes()->push_back(kIntrinsicsSize);
}

bool PointIntrinsicsFactor::Evaluate(double const* const* parameters, double* residuals,
                                     double** jacobians) const {
  if (!factor_->Evaluate(parameters, residuals, jacobians)) return false;
  const size_t intrinsics = parameter_block_sizes().size() - 1;
  Vector2Map{residuals} -= weight_ * shift_.At(parameters[intrinsics]);
  if (jacobians != nullptr && jacobians[intrinsics] != nullptr) {
    JacobianMap{jacobians[intrinsics]} = -weight_ * shift_.d_xy_d_intrinsics;
  }
  return true;
}

template <typename Factor>
LineIntrinsicsFactor<Factor>::LineIntrinsicsFactor(const LineSegmentView& view, double weight,
                                                   const RayShift& start_shift,
                                                   const RayShift& end_shift)
    : view_(view), weight_(weight), start_shift_(start_shift), end_shift_(end_shift) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = Factor(view, weight).parameter_block_sizes();
  mutable_parameter_block_sizes()->push_back(kIntrinsicsSize);
}

template <typename Factor>
bool LineIntrinsicsFactor<Factor>::Evaluate(double const* const* parameters, double* residuals,
                                            double** jacobians) const {
  const size_t intrinsics = parameter_block_sizes().size() - 1;
  const double* c = parameters[intrinsics];
  const LineSegmentView seen{view_.start + start_shift_.At(c), view_.end + end_shift_.At(c)};
  Eigen::Vector2d normal;
  if (!Factor(seen, weight_).EvaluateWithNormal(parameters, residuals, jacobians, &normal)) {
    return false;
  }
  if (jacobians != nullptr && jacobians[intrinsics] != nullptr) {
    JacobianMap J(jacobians[intrinsics]);
    J.row(0) = weight_ * normal.transpose() * start_shift_.d_xy_d_intrinsics;
    J.row(1) = weight_ * normal.transpose() * end_shift_.d_xy_d_intrinsics;
  }
  return true;
}

template class LineIntrinsicsFactor<LineFactor>;
template class LineIntrinsicsFactor<LineHostFactor>;

}  // namespace plm_vins
