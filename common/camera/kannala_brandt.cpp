// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/kannala_brandt.h"

#include <cmath>

namespace plm_vins {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Returns the symmetric matrix with eigenvalue `radial` along the unit vector `u` and `tangential`
// perpendicular to it.
Eigen::Matrix2d RadialTangential(const Eigen::Vector2d& u, double radial, double tangential) {
  return tangential * Eigen::Matrix2d::Identity() + (radial - tangential) * u * u.transpose();
}

// Returns the direction of `v`; any direction if it is zero, since radial and tangential scale are
// equal there.
Eigen::Vector2d Direction(const Eigen::Vector2d& v, double norm) {
  return norm > 0 ? Eigen::Vector2d(v / norm) : Eigen::Vector2d::UnitX();
}

}  // namespace

KannalaBrandt::KannalaBrandt(const CameraParameters& parameters)
    : CameraModel(parameters), k_(parameters.distortion), max_theta_(FindMaxTheta()) {}

double KannalaBrandt::Distort(double theta) const {
  const double t = theta * theta;
  return theta * (1 + t * (k_[0] + t * (k_[1] + t * (k_[2] + t * k_[3]))));
}

double KannalaBrandt::DistortDerivative(double theta) const {
  const double t = theta * theta;
  return 1 + t * (3 * k_[0] + t * (5 * k_[1] + t * (7 * k_[2] + t * 9 * k_[3])));
}

// Searches outwards while theta_d increases, with decreasing step size.
double KannalaBrandt::FindMaxTheta() const {
  double theta = 0;
  for (double step = 1e-3; step > 1e-12; step *= 0.5) {
    while (theta + step < kPi && DistortDerivative(theta + step) > 0) theta += step;
  }
  return theta;
}

// Newton's method inside a shrinking bracket, which is valid since theta_d is monotonic.
double KannalaBrandt::Undistort(double theta_d) const {
  double low = 0, high = max_theta_;
  double theta = theta_d < max_theta_ ? theta_d : 0.5 * max_theta_;
  for (int i = 0; i < 60; ++i) {
    const double error = Distort(theta) - theta_d;
    (error > 0 ? high : low) = theta;
    double next = theta - error / DistortDerivative(theta);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (next == theta) break;
    theta = next;
  }
  return theta;
}

std::optional<Eigen::Vector2d> KannalaBrandt::Project(
    const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const {
  const double radius = p_C.head<2>().norm();
  const double z = p_C.z();
  const double theta = std::atan2(radius, z);
  if (!p_C.allFinite() || p_C.isZero(0) || theta >= max_theta_) return std::nullopt;
  const double theta_d = Distort(theta);
  const Eigen::Vector2d u = Direction(p_C.head<2>(), radius);
  if (d_pixel_d_point) {
    const double d_theta_d = DistortDerivative(theta) / p_C.squaredNorm();
    Eigen::Matrix<double, 2, 3> d_plane;
    d_plane << RadialTangential(u, d_theta_d * z, radius > 0 ? theta_d / radius : 1 / z),
        -d_theta_d * radius * u;
    *d_pixel_d_point = focal().asDiagonal() * d_plane;
  }
  return PlaneToPixel(theta_d * u);
}

std::optional<Eigen::Vector2d> KannalaBrandt::Unproject(const Eigen::Vector2d& pixel,
                                                        Eigen::Matrix2d* d_xy_d_pixel) const {
  const Eigen::Vector2d plane = PixelToPlane(pixel);
  const double theta_d = plane.norm();
  if (!(theta_d < Distort(max_theta_))) return std::nullopt;
  const double theta = Undistort(theta_d);
  const double cosine = std::cos(theta);
  if (cosine <= 1e-9) return std::nullopt;  // not in front of the camera
  const double tangent = std::tan(theta);
  const Eigen::Vector2d u = Direction(plane, theta_d);
  if (d_xy_d_pixel) {
    const double radial = 1 / (cosine * cosine * DistortDerivative(theta));
    *d_xy_d_pixel = RadialTangential(u, radial, theta_d > 0 ? tangent / theta_d : 1) *
                    focal().cwiseInverse().asDiagonal();
  }
  return Eigen::Vector2d(tangent * u);
}

Eigen::Matrix<double, 2, 4> KannalaBrandt::PlaneByDistortion(const Eigen::Vector2d& xy) const {
  const double radius = xy.norm(), theta = std::atan(radius), t = theta * theta;
  const Eigen::RowVector4d powers(t, t * t, t * t * t, t * t * t * t);
  return theta * Direction(xy, radius) * powers;
}

double KannalaBrandt::FocalLength() const { return focal().mean(); }

}  // namespace plm_vins
