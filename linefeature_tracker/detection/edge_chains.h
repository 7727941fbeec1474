// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Pixels of an edge, each next to the one before.
using EdgeChain = std::vector<cv::Point>;

// Takes edges, one pixel wide, apart into chains [Lee2014]: each begins at the first pixel left, by
// rows, and goes on to the neighbour that turns least from the mean direction so far, unless that
// is a right angle or more.
class EdgeChains {
 public:
  // Edges of a CV_8UC1 image by Canny, apertures of 3 pixels, with thresholds of its gradient.
  EdgeChains(const cv::Mat& image, double low, double high);

  // The next chain; false where none is left.
  bool Next(EdgeChain* chain);

 private:
  bool FindSeed();
  bool Continue(EdgeChain* chain);
  void Take(cv::Point pixel, EdgeChain* chain);

  cv::Mat edges_;  // with a rim of one pixel without edges; pixels of chains are taken out
  cv::Point seed_{0, 0};
  float mean_direction_ = 0;  // of the chain [45 deg]
};

}  // namespace plm_vins
