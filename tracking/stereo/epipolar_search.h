// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// A point in the image of the first camera of a pair.
struct SearchedPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalized, undistorted point of `pixel`
};

// The part of the second image that is searched.
struct SearchRange {
  double from = 0, to = 0;  // inverse depths [1/m]
  double band_px = 0;       // search range to both sides of the epipolar curve
};

// Finds the point of the `second` image whose surroundings look like those of the point in the
// `first` one (both CV_8UC1), warped by the pair's lenses. Returns nullopt if no point of the range
// matches, or more than one.
std::optional<CurvePoint> SearchAlongCurve(const CameraPair& pair, const cv::Mat& first,
                                           const SearchedPoint& point, const cv::Mat& second,
                                           const SearchRange& range);

}  // namespace plm_vins
