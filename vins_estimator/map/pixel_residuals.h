// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/camera/camera_model.h"
#include "vins_estimator/map/local_map.h"

namespace plm_vins {

// Reprojection error of a point in the raw image.
struct PixelResidual {
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();     // observed pixel
  Eigen::Vector2d error_px = Eigen::Vector2d::Zero();  // predicted minus observed
};

// Returns the residuals of the optimized points in one image of the window. `configured` are the
// parameters of its camera; rays are those of the window's ray_intrinsics.
std::vector<PixelResidual> PixelResiduals(const LocalMap& map, const ImageKey& image,
                                          const CameraParameters& configured);

}  // namespace plm_vins
