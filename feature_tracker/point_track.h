// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "feature_tracker/following/corner_patch.h"

namespace plm_vins {

// One corner that is being followed, as of the newest image.
struct PointTrack {
  int64_t id = -1;
  int length = 1;           // images it was seen in
  cv::Point2f uv_px;        // raw pixel
  cv::Point2f motion_px;    // since the image before; zero when new
  cv::Point2f parallax_px;  // the part of it that the camera's known rotation does not explain
  std::shared_ptr<const CornerPatch> patch;                    // to align with, if there is one
  Eigen::Matrix2d patch_linear = Eigen::Matrix2d::Identity();  // of its pose around uv_px
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();                // normalised, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();          // d(xy)/dt [1/s]; zero when new
};

}  // namespace plm_vins
