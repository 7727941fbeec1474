// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/mei.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

constexpr double kMargin = 1e-9;  // distance from singular rays

}  // namespace

Mei::Mei(const CameraParameters& parameters)
    : CameraModel(parameters),
      xi_(parameters.model == CameraParameters::Model::kMei ? parameters.xi : 0),
      min_cosine_(kMargin - (xi_ > 1 ? 1 / xi_ : xi_)),
      distortion_(parameters.distortion) {}

std::optional<Eigen::Vector2d> Mei::Project(const Eigen::Vector3d& p_C,
                                            Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const {
  const double norm = p_C.norm();
  if (!(p_C.z() > min_cosine_ * norm)) return std::nullopt;
  const double denominator = p_C.z() + xi_ * norm;
  const Eigen::Vector2d point = p_C.head<2>() / denominator;
  Eigen::Matrix2d d_distorted_d_point;
  const auto distorted = distortion_.Distort(point, &d_distorted_d_point);
  if (!distorted) return std::nullopt;
  if (d_pixel_d_point) {
    const Eigen::RowVector3d d_denominator =
        Eigen::RowVector3d::UnitZ() + xi_ / norm * p_C.transpose();
    const Eigen::Matrix<double, 2, 3> d_point =
        (Eigen::Matrix<double, 2, 3>::Identity() - point * d_denominator) / denominator;
    *d_pixel_d_point = focal().asDiagonal() * d_distorted_d_point * d_point;
  }
  return PlaneToPixel(*distorted);
}

// With q = |point|^2 and root = sqrt(1 + (1 - xi^2) q), the point is lifted to the sphere as
// (lambda point, lambda - xi), lambda = (xi + root) / (1 + q)  [Mei2007, Eq. (6)]; hence xy = point
// / g(q), g = 1 - xi / lambda.
std::optional<Eigen::Vector2d> Mei::PlaneToRay(const Eigen::Vector2d& point,
                                               Eigen::Matrix2d* d_xy_d_point) const {
  const double q = point.squaredNorm();
  const double root_squared = 1 + (1 - xi_ * xi_) * q;
  if (!(root_squared > 0)) return std::nullopt;  // beyond the image of the sphere
  const double root = std::sqrt(root_squared);
  const double g = 1 - xi_ * (1 + q) / (xi_ + root);
  if (!(g > kMargin)) return std::nullopt;  // not in front of the camera
  if (d_xy_d_point) {
    const double d_root = (1 - xi_ * xi_) / (2 * root);
    const double d_g = -xi_ * (xi_ + root - (1 + q) * d_root) / ((xi_ + root) * (xi_ + root));
    *d_xy_d_point = (Eigen::Matrix2d::Identity() - 2 * d_g / g * point * point.transpose()) / g;
  }
  return Eigen::Vector2d(point / g);
}

std::optional<Eigen::Vector2d> Mei::Unproject(const Eigen::Vector2d& pixel,
                                              Eigen::Matrix2d* d_xy_d_pixel) const {
  Eigen::Matrix2d d_point_d_distorted, d_xy_d_point;
  const bool differentiates = d_xy_d_pixel != nullptr;
  const auto point =
      distortion_.Undistort(PixelToPlane(pixel), differentiates ? &d_point_d_distorted : nullptr);
  if (!point) return std::nullopt;
  auto xy = PlaneToRay(*point, differentiates ? &d_xy_d_point : nullptr);
  if (xy && d_xy_d_pixel) {
    *d_xy_d_pixel = d_xy_d_point * d_point_d_distorted * focal().cwiseInverse().asDiagonal();
  }
  return xy;
}

Eigen::Matrix<double, 2, 4> Mei::PlaneByDistortion(const Eigen::Vector2d& xy) const {
  return RadtanDistortion::DistortedByCoefficients(xy / (1 + xi_ * xy.homogeneous().norm()));
}

double Mei::FocalLength() const { return focal().mean() / (1 + xi_); }

}  // namespace plm_vins
