// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Pixels of an edge, each adjacent to the previous one.
using EdgeChain = std::vector<cv::Point>;

// Decomposes edges, one pixel wide, into chains [Lee2014]. A chain begins at the first remaining
// edge pixel in row-major order and continues with the neighbour that deviates least from its mean
// direction, as long as the deviation is below a right angle.
class EdgeChains {
 public:
  // Detects edges of a CV_8UC1 image by Canny with 3 x 3 apertures; `low` and `high` are thresholds
  // of the gradient.
  EdgeChains(const cv::Mat& image, double low, double high);

  // Finds the next chain; returns false if none is left.
  bool Next(EdgeChain* chain);

 private:
  bool FindSeed();
  bool Continue(EdgeChain* chain);
  void Take(cv::Point pixel, EdgeChain* chain);

  cv::Mat edges_;  // with a margin of one pixel; pixels of chains are erased
  cv::Point seed_{0, 0};
  float mean_direction_ = 0;  // of the chain [45 deg]
};

}  // namespace plm_vins
