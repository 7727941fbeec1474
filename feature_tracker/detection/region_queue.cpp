// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/detection/region_queue.h"

#include <cmath>

namespace plm_vins {

RegionQueue::RegionQueue(const cv::Size& image_size, int region_count)
    : region_size_(std::sqrt(static_cast<double>(image_size.area()) / region_count)),
      columns_(static_cast<int>(image_size.width / region_size_) + 1),
      regions_(static_cast<size_t>(columns_) *
               (static_cast<int>(image_size.height / region_size_) + 1)) {}

void RegionQueue::AddCandidate(const cv::Point2f& position) {
  RegionAt(position).candidates.push_back(position);
}

void RegionQueue::CountPoint(const cv::Point2f& position) { ++RegionAt(position).points; }

std::optional<cv::Point2f> RegionQueue::Pop() {
  Region* poorest = nullptr;
  for (Region& region : regions_) {
    if (region.next == region.candidates.size()) continue;
    if (poorest == nullptr || region.points < poorest->points) poorest = &region;
  }
  if (poorest == nullptr) return std::nullopt;
  return poorest->candidates[poorest->next++];
}

RegionQueue::Region& RegionQueue::RegionAt(const cv::Point2f& position) {
  const int column = static_cast<int>(position.x / region_size_);
  const int row = static_cast<int>(position.y / region_size_);
  return regions_[row * columns_ + column];
}

}  // namespace plm_vins
