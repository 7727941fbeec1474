// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/intrinsics_factor.h"

#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/stereo_factor.h"

namespace plm_vins {
namespace {

using Vector2Map = Eigen::Map<Eigen::Vector2d>;
using JacobianMap = Eigen::Map<Eigen::Matrix<double, 2, kIntrinsicsSize, Eigen::RowMajor>>;

// Weights of both ends of a line.
Eigen::Vector2d OfEnds(double weight) { return {weight, weight}; }
Eigen::Vector2d OfEnds(const Eigen::Vector2d& weights) { return weights; }

}  // namespace

template <typename Inner>
PointIntrinsicsFactor<Inner>::PointIntrinsicsFactor(const Inner& factor, const RayShift& shift,
                                                    double weight)
    : Factor(2), factor_(factor), shift_(shift), weight_(weight) {}

template <typename Inner>
bool PointIntrinsicsFactor<Inner>::Evaluate(double const* const* parameters, double* residuals,
                                            double** jacobians) const {
  constexpr int kIntrinsics = Inner::kBlocks;
  if (!factor_.Evaluate(parameters, residuals, jacobians)) return false;
  Vector2Map{residuals} -= weight_ * shift_.At(parameters[kIntrinsics]);
  if (jacobians != nullptr && jacobians[kIntrinsics] != nullptr) {
    JacobianMap{jacobians[kIntrinsics]} = -weight_ * shift_.d_xy_d_intrinsics;
  }
  return true;
}

template <typename Inner>
LineIntrinsicsFactor<Inner>::LineIntrinsicsFactor(const LineSegmentView& view, const Weight& weight,
                                                  const RayShift& start_shift,
                                                  const RayShift& end_shift)
    : Factor(2), view_(view), weight_(weight), start_shift_(start_shift), end_shift_(end_shift) {}

template <typename Inner>
bool LineIntrinsicsFactor<Inner>::Evaluate(double const* const* parameters, double* residuals,
                                           double** jacobians) const {
  constexpr int kIntrinsics = Inner::kBlocks;
  const double* c = parameters[kIntrinsics];
  const LineSegmentView seen{view_.start + start_shift_.At(c), view_.end + end_shift_.At(c)};
  Eigen::Vector2d normal;
  if (!Inner(seen, weight_).EvaluateWithNormal(parameters, residuals, jacobians, &normal)) {
    return false;
  }
  if (jacobians != nullptr && jacobians[kIntrinsics] != nullptr) {
    JacobianMap J(jacobians[kIntrinsics]);
    const Eigen::Vector2d weights = OfEnds(weight_);
    J.row(0) = weights[0] * normal.transpose() * start_shift_.d_xy_d_intrinsics;
    J.row(1) = weights[1] * normal.transpose() * end_shift_.d_xy_d_intrinsics;
  }
  return true;
}

template class PointIntrinsicsFactor<PointFactor>;
template class PointIntrinsicsFactor<PointHostFactor>;
template class PointIntrinsicsFactor<RightPointFactor>;
template class PointIntrinsicsFactor<RightPointHostFactor>;
template class LineIntrinsicsFactor<LineFactor>;
template class LineIntrinsicsFactor<LineHostFactor>;
template class LineIntrinsicsFactor<RightLineFactor>;
template class LineIntrinsicsFactor<RightLineHostFactor>;

}  // namespace plm_vins
