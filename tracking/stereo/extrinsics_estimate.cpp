// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/extrinsics_estimate.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/epipolar_constraint.h"
#include "common/geometry/robust_weight.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

constexpr double kDegree = M_PI / 180;
// Standard deviations of the errors of stated extrinsics.
constexpr double kRotationPrior = 0.4 * kDegree;  // [rad]
constexpr double kBaselinePrior = 0.4 * kDegree;  // [rad]
constexpr double kDelayPrior = 0.01;              // [s]
constexpr double kZoomPrior = 0.02;               // relative
constexpr double kLeastZoom = 0.01;               // that matters
constexpr double kCertain = 5;                    // standard deviations
constexpr double kMatchDeviation_px = 0.5;        // match, including errors of lens models
constexpr double kGate = 3.0;                     // standard deviations
constexpr double kMemory = 0.99;  // share of its weight that an image keeps with the next
constexpr double kScales_px[] = {4, 2, 1, 0.5};  // scales of the robust weights, one per iteration

}  // namespace

ExtrinsicsEstimate::ExtrinsicsEstimate(const Rigid3d& stated_T_S_C, double focal_length)
    : stated_T_S_C_(stated_T_S_C),
      focal_length_(focal_length),
      baseline_direction_(stated_T_S_C.translation.normalized()),
      baseline_tangent_(TangentBasis(baseline_direction_)) {
  Vector deviations;
  deviations << kRotationPrior, kRotationPrior, kRotationPrior, kBaselinePrior, kBaselinePrior,
      kDelayPrior, kZoomPrior;
  covariance_ = deviations.cwiseAbs2().asDiagonal();
  prior_ = deviations.cwiseAbs2().cwiseInverse().asDiagonal();
}

Eigen::Vector2d ExtrinsicsEstimate::VelocityInSecond(const StereoMatch& match) const {
  const Eigen::Matrix3d R_S_C = stated_T_S_C_.R();
  const Eigen::Vector3d ray = R_S_C * match.xy.homogeneous();
  const Eigen::Vector3d motion = R_S_C.leftCols<2>() * match.velocity;
  return (motion.head<2>() - ray.hnormalized() * motion.z()) / ray.z();
}

ExtrinsicsEstimate::Linear ExtrinsicsEstimate::Linearize(const StereoMatch& match) const {
  const Eigen::Vector3d a = stated_T_S_C_.rotation * match.xy.homogeneous();
  const Eigen::Vector3d b = match.xy_S.homogeneous();
  const Eigen::Vector3d line = baseline_direction_.cross(a);
  const double weight = focal_length_ / std::max(line.head<2>().norm(), 1e-9);
  Linear linear;
  linear.error = weight * line.dot(b);
  linear.gradient.head<5>() =
      EpipolarGradient(weight, a, b, baseline_direction_, baseline_tangent_);
  // A match that is observed later lies further along its motion.
  linear.gradient[kDelay] = -weight * line.head<2>().dot(VelocityInSecond(match));
  linear.gradient[kZoom] = weight * line.head<2>().dot(match.xy_S);
  return linear;
}

void ExtrinsicsEstimate::Update(const std::vector<StereoMatch>& matches) {
  std::vector<Linear> linear;
  linear.reserve(matches.size());
  for (const StereoMatch& match : matches) linear.push_back(Linearize(match));
  Matrix information;
  Vector gradient;
  for (const double scale : kScales_px) {
    information = kMemory * information_;
    gradient = kMemory * gradient_;
    for (const Linear& one : linear) {
      const double error = one.error + one.gradient.dot(state_);
      const double weight =
          GemanMcClureWeight(error, scale) / (kMatchDeviation_px * kMatchDeviation_px);
      information += weight * one.gradient * one.gradient.transpose();
      gradient += weight * one.gradient * one.error;
    }
    const Matrix posterior = information + prior_;
    state_ = -SolveSymmetric(posterior, gradient);
    covariance_ = InverseOfSymmetric(posterior);
  }
  information_ = information;
  gradient_ = gradient;
}

bool ExtrinsicsEstimate::Accepts(const StereoMatch& match) const {
  const Linear linear = Linearize(match);
  const double variance = kMatchDeviation_px * kMatchDeviation_px + Variance(linear);
  return std::abs(linear.error + linear.gradient.dot(state_)) < kGate * std::sqrt(variance);
}

double ExtrinsicsEstimate::StatedError(const StereoMatch& match) const {
  return Linearize(match).error;
}

double ExtrinsicsEstimate::Error(const StereoMatch& match) const {
  const Linear linear = Linearize(match);
  return linear.error + linear.gradient.dot(state_);
}

Eigen::Vector2d ExtrinsicsEstimate::WithoutDelay(const StereoMatch& match) const {
  return match.xy_S - delay() * VelocityInSecond(match);
}

double ExtrinsicsEstimate::zoom() const {
  const double zoom = state_[kZoom], deviation = std::sqrt(covariance_(kZoom, kZoom));
  return std::abs(zoom) > std::max(kLeastZoom, kCertain * deviation) ? zoom : 0;
}

Rigid3d ExtrinsicsEstimate::T_S_C() const {
  const Eigen::Vector3d direction =
      (baseline_direction_ + baseline_tangent_ * state_.segment<2>(3)).normalized();
  return {(SO3Exp(rotation()) * stated_T_S_C_.rotation).normalized(),
          stated_T_S_C_.translation.norm() * direction};
}

double ExtrinsicsEstimate::Deviation(const StereoMatch& match) const {
  const Linear linear = Linearize(match);
  return std::sqrt(Variance(linear) + std::pow(linear.gradient[kZoom] * state_[kZoom], 2));
}

}  // namespace plm_vins
