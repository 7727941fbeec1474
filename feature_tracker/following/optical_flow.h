// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/config/config.h"

namespace plm_vins {

// A point to track, and where the search begins.
struct FlowStart {
  cv::Point2f point;      // in the previous image [px]
  cv::Point2f predicted;  // in the current one
  bool is_close = false;  // to a few pixels, so coarse levels are not needed
};

// Pyramidal Lucas-Kanade flow [Bouguet2001]. The pyramid of each image is built once, and used as
// the current and then as the previous one.
class OpticalFlow {
 public:
  using Pyramid = std::vector<cv::Mat>;  // levels, each with a border for the flow window

  explicit OpticalFlow(const PointTrackerConfig& config) : config_(config) {}

  // Reuses the memory of `unused`, a pyramid that is no longer needed.
  Pyramid BuildPyramid(const cv::Mat& image, Pyramid unused = {}) const;

  // Returns the positions of points of `previous` in `current`; nullopt if they are not found, or
  // outside the image.
  std::vector<std::optional<cv::Point2f>> Track(const Pyramid& previous, const Pyramid& current,
                                                const std::vector<FlowStart>& starts) const;

  // Returns whether the flow from where a point was found leads back to it.
  bool LeadsBack(const Pyramid& previous, const Pyramid& current, const cv::Point2f& point,
                 const cv::Point2f& found) const;

 private:
  PointTrackerConfig config_;
};

}  // namespace plm_vins
