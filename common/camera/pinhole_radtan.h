// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/camera/camera_model.h"
#include "common/camera/radtan_distortion.h"

namespace plm_vins {

// A pinhole camera with radial and tangential distortion of (X / Z, Y / Z).
class PinholeRadtan final : public CameraModel {
 public:
  explicit PinholeRadtan(const CameraParameters& parameters);

  std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const override;
  std::optional<Eigen::Vector2d> Unproject(const Eigen::Vector2d& pixel,
                                           Eigen::Matrix2d* d_xy_d_pixel) const override;
  double FocalLength() const override;

 private:
  Eigen::Matrix<double, 2, 4> PlaneByDistortion(const Eigen::Vector2d& xy) const override;
  RadtanDistortion distortion_;
};

}  // namespace plm_vins
