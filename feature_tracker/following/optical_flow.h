// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "common/config/config.h"

namespace plm_vins {

// Where one point went.
struct FlowResult {
  enum class Status {
    kTracked,
    kLost,          // not found again, or outside of the image
    kInconsistent,  // tracked backwards it does not return to where it came from
  };
  cv::Point2f position;  // [px]
  Status status = Status::kLost;
};

// Pyramidal Lucas-Kanade flow [Bouguet2001] with a forward-backward check. Each image's pyramid is
// built once and serves as current and then as previous one.
class OpticalFlow {
 public:
  using Pyramid = std::vector<cv::Mat>;  // levels, each with a border for the window

  explicit OpticalFlow(const PointTrackerConfig& config) : config_(config) {}

  // In the memory of a pyramid that is no longer needed, where there is one.
  Pyramid BuildPyramid(const cv::Mat& image, Pyramid unused = {}) const;

  // Follows `points` from `previous` to `current`, beginning at their `predicted` positions [px].
  std::vector<FlowResult> Track(const Pyramid& previous, const Pyramid& current,
                                const std::vector<cv::Point2f>& points,
                                const std::vector<cv::Point2f>& predicted) const;

 private:
  PointTrackerConfig config_;
};

}  // namespace plm_vins
