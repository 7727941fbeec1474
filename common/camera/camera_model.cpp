// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera/camera_model.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "common/camera/kannala_brandt.h"
#include "common/camera/mei.h"

namespace plm_vins {
namespace {

void Check(const CameraParameters& p) {
  if (!p.intrinsics().allFinite() || !std::isfinite(p.xi)) {
    throw std::invalid_argument("camera model: every parameter must be a finite number");
  }
  if (p.fx <= 0 || p.fy <= 0) {
    throw std::invalid_argument("camera model: focal lengths must be positive");
  }
  if (p.xi < 0) throw std::invalid_argument("camera model: xi must not be negative");
}

}  // namespace

Intrinsics CameraParameters::intrinsics() const {
  Intrinsics intrinsics;
  intrinsics << fx, fy, cx, cy, distortion;
  return intrinsics;
}

CameraParameters CameraParameters::With(const Intrinsics& intrinsics) const {
  CameraParameters camera = *this;
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  camera.distortion = intrinsics.tail<4>();
  return camera;
}

std::unique_ptr<const CameraModel> CameraModel::Create(const CameraParameters& parameters) {
  Check(parameters);
  switch (parameters.model) {
    case CameraParameters::Model::kPinholeEquidistant:
      return std::make_unique<KannalaBrandt>(parameters);
    case CameraParameters::Model::kPinholeRadtan:
    case CameraParameters::Model::kMei:
      return std::make_unique<Mei>(parameters);
  }
  throw std::invalid_argument("camera model: unknown model");
}

// Implicit differentiation at constant pixel: 0 = d_pixel_d_xy d_xy + d_pixel_d_intrinsics
// d_intrinsics.
std::optional<IntrinsicsJacobian> CameraModel::RayByIntrinsics(const Eigen::Vector2d& xy) const {
  Eigen::Matrix<double, 2, 3> d_pixel_d_ray;
  const auto pixel = Project(xy.homogeneous(), &d_pixel_d_ray);
  if (!pixel) return std::nullopt;
  IntrinsicsJacobian d_pixel_d_intrinsics;
  d_pixel_d_intrinsics << PixelToPlane(*pixel).asDiagonal().toDenseMatrix(),
      Eigen::Matrix2d::Identity(), focal().asDiagonal() * PlaneByDistortion(xy);
  return -d_pixel_d_ray.leftCols<2>().inverse() * d_pixel_d_intrinsics;
}

}  // namespace plm_vins
