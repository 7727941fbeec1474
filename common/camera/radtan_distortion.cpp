// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/radtan_distortion.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace plm_vins {
namespace {

constexpr int kMaxIterations = 50;
constexpr int kMaxHalvings = 60;  // for distant points, where the distortion is of fifth order
constexpr double kTolerance = 4 * std::numeric_limits<double>::epsilon();

// Smallest s = r^2 > 0 at which r (1 + k1 s + k2 s^2) stops increasing: 1 + 3 k1 s + 5 k2 s^2 = 0.
double FoldRadiusSquared(double k1, double k2) {
  const double a = 5 * k2;
  const double b = 3 * k1;
  const double discriminant = b * b - 4 * a;
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  // The smallest positive root, if any, in a form that is numerically stable as a goes to zero.
  const double denominator = -b + std::sqrt(discriminant);
  return denominator > 0 ? 2 / denominator : std::numeric_limits<double>::infinity();
}

}  // namespace

RadtanDistortion::RadtanDistortion(const Eigen::Vector4d& k1_k2_p1_p2)
    : k1_(k1_k2_p1_p2[0]),
      k2_(k1_k2_p1_p2[1]),
      p1_(k1_k2_p1_p2[2]),
      p2_(k1_k2_p1_p2[3]),
      max_radius_squared_(FoldRadiusSquared(k1_, k2_)) {}

std::optional<Eigen::Vector2d> RadtanDistortion::Distort(
    const Eigen::Vector2d& point, Eigen::Matrix2d* d_distorted_d_point) const {
  const double x = point.x(), y = point.y();
  const double r2 = point.squaredNorm();
  if (!(r2 < max_radius_squared_)) return std::nullopt;
  const double radial = 1 + r2 * (k1_ + r2 * k2_);
  const double d_radial = 2 * (k1_ + 2 * r2 * k2_);  // gradient is d_radial * (x, y)

  Eigen::Matrix2d jacobian;
  jacobian(0, 0) = radial + d_radial * x * x + 2 * p1_ * y + 6 * p2_ * x;
  jacobian(0, 1) = d_radial * x * y + 2 * p1_ * x + 2 * p2_ * y;
  jacobian(1, 0) = jacobian(0, 1);
  jacobian(1, 1) = radial + d_radial * y * y + 6 * p1_ * y + 2 * p2_ * x;
  if (!(jacobian.determinant() > 0)) return std::nullopt;  // folded by the tangential part
  if (d_distorted_d_point) *d_distorted_d_point = jacobian;

  return Eigen::Vector2d(x * radial + 2 * p1_ * x * y + p2_ * (r2 + 2 * x * x),
                         y * radial + p1_ * (r2 + 2 * y * y) + 2 * p2_ * x * y);
}

Eigen::Matrix<double, 2, 4> RadtanDistortion::DistortedByCoefficients(
    const Eigen::Vector2d& point) {
  const double x = point.x(), y = point.y(), r2 = point.squaredNorm();
  Eigen::Matrix<double, 2, 4> derivative;
  derivative << r2 * x, r2 * r2 * x, 2 * x * y, r2 + 2 * x * x,  //
      r2 * y, r2 * r2 * y, r2 + 2 * y * y, 2 * x * y;
  return derivative;
}

// Newton's method; a step that leaves the invertible disc or increases the error is halved.
std::optional<Eigen::Vector2d> RadtanDistortion::Undistort(
    const Eigen::Vector2d& distorted, Eigen::Matrix2d* d_point_d_distorted) const {
  if (!distorted.allFinite()) return std::nullopt;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
  Eigen::Vector2d error = distorted;
  for (int i = 0; i < kMaxIterations && error.norm() > kTolerance * (1 + distorted.norm()); ++i) {
    Eigen::Vector2d step = jacobian.inverse() * error;
    bool improved = false;
    for (int halving = 0; halving < kMaxHalvings && !improved; ++halving, step *= 0.5) {
      Eigen::Matrix2d next_jacobian;
      const auto image = Distort(point + step, &next_jacobian);
      improved = image && (distorted - *image).norm() < error.norm();
      if (!improved) continue;
      point += step;
      error = distorted - *image;
      jacobian = next_jacobian;
    }
    if (!improved) break;
  }
  if (!(error.norm() <= 10 * kTolerance * (1 + distorted.norm()))) return std::nullopt;
  if (d_point_d_distorted) *d_point_d_distorted = jacobian.inverse();
  return point;
}

}  // namespace plm_vins
