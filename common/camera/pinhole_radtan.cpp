// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/pinhole_radtan.h"

namespace plm_vins {
namespace {

constexpr double kMinCosine = 1e-9;  // rays closer to the image plane are rejected

}  // namespace

PinholeRadtan::PinholeRadtan(const CameraParameters& parameters)
    : CameraModel(parameters), distortion_(parameters.distortion) {}

std::optional<Eigen::Vector2d> PinholeRadtan::Project(
    const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const {
  if (!(p_C.z() > kMinCosine * p_C.norm())) return std::nullopt;
  const Eigen::Vector2d xy = p_C.head<2>() / p_C.z();
  Eigen::Matrix2d d_distorted_d_xy;
  const auto distorted = distortion_.Distort(xy, &d_distorted_d_xy);
  if (!distorted) return std::nullopt;
  if (d_pixel_d_point) {
    Eigen::Matrix<double, 2, 3> d_xy_d_point;
    d_xy_d_point << Eigen::Matrix2d::Identity(), -xy;
    *d_pixel_d_point = focal().asDiagonal() * d_distorted_d_xy * d_xy_d_point / p_C.z();
  }
  return PlaneToPixel(*distorted);
}

std::optional<Eigen::Vector2d> PinholeRadtan::Unproject(const Eigen::Vector2d& pixel,
                                                        Eigen::Matrix2d* d_xy_d_pixel) const {
  auto xy = distortion_.Undistort(PixelToPlane(pixel), d_xy_d_pixel);
  if (xy && d_xy_d_pixel) *d_xy_d_pixel *= focal().cwiseInverse().asDiagonal();
  return xy;
}

Eigen::Matrix<double, 2, 4> PinholeRadtan::PlaneByDistortion(const Eigen::Vector2d& xy) const {
  return RadtanDistortion::DistortedByCoefficients(xy);
}

double PinholeRadtan::FocalLength() const { return focal().mean(); }

}  // namespace plm_vins
