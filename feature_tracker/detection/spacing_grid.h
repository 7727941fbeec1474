// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Points of an image, sorted into cells so that "is there one closer than the minimum distance?"
// costs a look into nine cells only.
class SpacingGrid {
 public:
  // `min_distance` in pixels, positive. Points must lie inside of an image of this size.
  SpacingGrid(cv::Size image_size, double min_distance);

  void Add(const cv::Point2f& point);

  // True where no point added so far is closer than the minimum distance.
  bool IsFree(const cv::Point2f& point) const;

 private:
  using Cell = std::vector<cv::Point2f>;

  int Column(const cv::Point2f& point) const { return static_cast<int>(point.x / min_distance_); }
  int Row(const cv::Point2f& point) const { return static_cast<int>(point.y / min_distance_); }

  double min_distance_;
  int columns_;
  int rows_;
  std::vector<Cell> cells_;  // row by row
};

}  // namespace plm_vins
