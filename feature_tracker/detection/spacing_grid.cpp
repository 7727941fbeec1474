// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/spacing_grid.h"

#include <algorithm>

namespace plm_vins {

SpacingGrid::SpacingGrid(cv::Size image_size, double min_distance)
    : min_distance_(min_distance),
      columns_(static_cast<int>(image_size.width / min_distance) + 1),
      rows_(static_cast<int>(image_size.height / min_distance) + 1),
      cells_(static_cast<size_t>(columns_) * rows_) {}

void SpacingGrid::Add(const cv::Point2f& point) {
  cells_[Row(point) * columns_ + Column(point)].push_back(point);
}

bool SpacingGrid::IsFree(const cv::Point2f& point) const {
  const auto is_close = [&](const cv::Point2f& other) {
    return cv::norm(other - point) < min_distance_;
  };
  const int column = Column(point);
  const int row = Row(point);
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, columns_ - 1); ++x) {
      const Cell& cell = cells_[y * columns_ + x];
      if (std::any_of(cell.begin(), cell.end(), is_close)) return false;
    }
  }
  return true;
}

}  // namespace plm_vins
