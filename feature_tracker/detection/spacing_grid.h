// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace plm_vins {

// Enforces a minimum distance between image points. Points are sorted into cells, so that a query
// inspects nine cells only.
class SpacingGrid {
 public:
  // `min_distance` is positive [px]. Points must be inside an image of this size.
  SpacingGrid(cv::Size image_size, double min_distance);

  void Add(const cv::Point2f& point);

  // Returns whether no added point is closer than the minimum distance.
  bool IsFree(const cv::Point2f& point) const;

 private:
  using Cell = std::vector<cv::Point2f>;

  int Column(const cv::Point2f& point) const { return static_cast<int>(point.x / min_distance_); }
  int Row(const cv::Point2f& point) const { return static_cast<int>(point.y / min_distance_); }

  double min_distance_;
  int columns_;
  int rows_;
  std::vector<Cell> cells_;  // row-major
};

}  // namespace plm_vins
