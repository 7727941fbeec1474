// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/camera/camera_model.h"
#include "common/camera/radtan_distortion.h"

namespace plm_vins {

// Unified omnidirectional camera [Mei2007]: the point is projected onto the unit sphere and then
// from a center at distance xi behind the sphere's center, (X, Y) / (Z + xi |p|); then radial and
// tangential distortion and scaling by gamma1, gamma2. The pinhole camera with radial and
// tangential distortion of (X / Z, Y / Z) is the one with xi = 0.
class Mei final : public CameraModel {
 public:
  explicit Mei(const CameraParameters& parameters);

  std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const override;
  std::optional<Eigen::Vector2d> Unproject(const Eigen::Vector2d& pixel,
                                           Eigen::Matrix2d* d_xy_d_pixel) const override;
  double FocalLength() const override;

 private:
  Eigen::Matrix<double, 2, 4> PlaneByDistortion(const Eigen::Vector2d& xy) const override;
  // Returns the ray (x, y, 1) through a point of the undistorted image plane.
  std::optional<Eigen::Vector2d> PlaneToRay(const Eigen::Vector2d& point,
                                            Eigen::Matrix2d* d_xy_d_point) const;

  double xi_;
  double min_cosine_;  // the projection is injective for rays with Z > min_cosine_ |p|
  RadtanDistortion distortion_;
};

}  // namespace plm_vins
