// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "common/measurements.h"
#include "feature_tracker/following/corner_patch.h"

namespace plm_vins {

// A corner in the image of the second camera of a pair, at the time of the first one's image.
struct SecondView {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalized, undistorted
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();
};

// A tracked corner in the newest image.
struct PointTrack {
  int64_t id = -1;
  int length = 1;           // number of images that it was observed in
  cv::Point2f uv_px;        // raw pixel
  cv::Point2f motion_px;    // since the previous image; zero when new
  cv::Point2f parallax_px;  // part of motion_px that the known camera rotation does not explain
  std::shared_ptr<const CornerPatch> patch;                    // for alignment; may be null
  Eigen::Matrix2d patch_linear = Eigen::Matrix2d::Identity();  // `linear` of the patch's pose
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();                // normalized, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();          // d(xy)/dt [1/s]; zero when new
  std::optional<SecondView> second;                            // if matched in the newest image
  std::optional<double> inverse_depth;  // from the last match in the second camera [1/m]
  std::optional<double> depth;          // measured by the depth sensor [m]
};

}  // namespace plm_vins
