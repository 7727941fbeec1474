// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "common/config/config.h"

namespace plm_vins {

// Tracking result of one point.
struct FlowResult {
  enum class Status {
    kTracked,
    kLost,          // not found, or outside the image
    kInconsistent,  // failed the forward-backward check
  };
  cv::Point2f position;  // [px]
  Status status = Status::kLost;
};

// Pyramidal Lucas-Kanade flow [Bouguet2001] with a forward-backward check. The pyramid of each
// image is built once, and used as the current and then as the previous one.
class OpticalFlow {
 public:
  using Pyramid = std::vector<cv::Mat>;  // levels, each with a border for the flow window

  explicit OpticalFlow(const PointTrackerConfig& config) : config_(config) {}

  // Reuses the memory of `unused`, a pyramid that is no longer needed.
  Pyramid BuildPyramid(const cv::Mat& image, Pyramid unused = {}) const;

  // Tracks `points` from `previous` to `current`, starting at the `predicted` positions [px].
  std::vector<FlowResult> Track(const Pyramid& previous, const Pyramid& current,
                                const std::vector<cv::Point2f>& points,
                                const std::vector<cv::Point2f>& predicted) const;

 private:
  PointTrackerConfig config_;
};

}  // namespace plm_vins
