// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// A place in the image of the first camera of a pair.
struct SearchedPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // the same, normalised and undistorted
};

// The part of the second image to search.
struct SearchRange {
  double from = 0, to = 0;  // inverse depths [1/m]
  double band_px = 0;       // to both sides of the epipolar curve
};

// Finds the place in the `second` image that looks like the surroundings of the point in the
// `first` one (both CV_8UC1), warped by the pair's lenses. Returns nullopt where nothing in the
// range looks like it, or more than one place does.
std::optional<CurvePoint> SearchAlongCurve(const CameraPair& pair, const cv::Mat& first,
                                           const SearchedPoint& point, const cv::Mat& second,
                                           const SearchRange& range);

}  // namespace plm_vins
