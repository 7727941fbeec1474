// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/region_queue.h"

#include <cmath>

namespace plm_vins {

RegionQueue::RegionQueue(const cv::Size& image_size, int region_count)
    : region_size_(std::sqrt(static_cast<double>(image_size.area()) / region_count)),
      columns_(static_cast<int>(image_size.width / region_size_) + 1),
      queue_(static_cast<size_t>(columns_) *
             (static_cast<int>(image_size.height / region_size_) + 1)) {}

size_t RegionQueue::RegionOf(const cv::Point2f& position) const {
  const int column = static_cast<int>(position.x / region_size_);
  const int row = static_cast<int>(position.y / region_size_);
  return static_cast<size_t>(row) * columns_ + column;
}

}  // namespace plm_vins
