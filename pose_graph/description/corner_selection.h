// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "pose_graph/description/descriptor.h"

namespace plm_vins {

struct CornerSelectionOptions {
  int max_corners = 300;                 // including the known corners
  int cell_px = 32;                      // grid cell size; each cell takes one new corner
  int fast_threshold = 12;               // [gray levels]
  int border_px = kDescriptorBorder_px;  // margin without corners, where descriptors do not fit
};

// Selects the strongest FAST corner of each grid cell without a corner in `known_px`, up to
// `max_corners` in total. Returns raw pixels in descending order of response.
std::vector<Eigen::Vector2f> SelectCorners(const CornerSelectionOptions& options,
                                           const cv::Mat& gray,
                                           const std::vector<Eigen::Vector2f>& known_px);

}  // namespace plm_vins
