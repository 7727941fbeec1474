// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_queue.h"

namespace plm_vins {
namespace {

constexpr int kColumns = 4;
constexpr int kRows = 3;
constexpr int kDirections = 4;

int Bin(double value, double range, int count) {
  return std::clamp(static_cast<int>(value / range * count), 0, count - 1);
}

}  // namespace

LineQueue::LineQueue(const cv::Size& image_size)
    : image_size_(image_size), queue_(kColumns * kRows * kDirections) {}

// Direction bins are centered at the image axes, so that vertical and horizontal lines do not lie
// on a bin boundary.
size_t LineQueue::BinOf(const LineSegment& segment_px) const {
  const Eigen::Vector2d middle = segment_px.Midpoint();
  const Eigen::Vector2d direction = segment_px.Direction();
  const double angle = std::atan2(direction.y(), direction.x()) + M_PI / (2 * kDirections);
  const double wrapped = angle - M_PI * std::floor(angle / M_PI);
  const int region = Bin(middle.y(), image_size_.height, kRows) * kColumns +
                     Bin(middle.x(), image_size_.width, kColumns);
  return region * kDirections + Bin(wrapped, M_PI, kDirections);
}

}  // namespace plm_vins
