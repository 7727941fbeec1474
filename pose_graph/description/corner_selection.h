// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "pose_graph/description/descriptor.h"

namespace plm_vins {

struct CornerSelectionOptions {
  int max_corners = 300;                 // with those that are there already
  int cell_px = 32;                      // of the grid, one new corner in each
  int fast_threshold = 12;               // [grey levels]
  int border_px = kDescriptorBorder_px;  // without corners: a descriptor does not fit there
};

// Corners that fill up an image: the strongest by FAST in each cell of a grid that has none in
// `known_px`, the strongest cells first. Raw pixels, in order of strength.
std::vector<Eigen::Vector2f> SelectCorners(const CornerSelectionOptions& options,
                                           const cv::Mat& gray,
                                           const std::vector<Eigen::Vector2f>& known_px);

}  // namespace plm_vins
