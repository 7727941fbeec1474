// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera_model.h"

namespace plm_vins {

// Moves a ray (x, y, 1), by its normalised image point, from one calibration of a camera to where
// another one sees the same pixel, and its velocity in the image with it. One that either does not
// see, at the rim of what a distortion can describe, stays where it is.
inline void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy,
                        Eigen::Vector2d* velocity) {
  Eigen::Matrix<double, 2, 3> d_pixel_d_ray;
  const auto pixel = from.Project(xy->homogeneous(), &d_pixel_d_ray);
  if (!pixel) return;
  Eigen::Matrix2d d_xy_d_pixel;
  const auto moved = to.Unproject(*pixel, &d_xy_d_pixel);
  if (!moved) return;
  *xy = *moved;
  *velocity = d_xy_d_pixel * (d_pixel_d_ray.leftCols<2>() * *velocity);
}

inline void TransferRay(const CameraModel& from, const CameraModel& to, Eigen::Vector2d* xy) {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  TransferRay(from, to, xy, &velocity);
}

}  // namespace plm_vins
