// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_pairs.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d BoxAround(const SeenLine& line, double margin) {
  const Vector3d margins = Vector3d::Constant(margin);
  return {line.start_F.cwiseMin(line.end_F) - margins, line.start_F.cwiseMax(line.end_F) + margins};
}

Vector3d CommonDirection(const SeenLine& a, const SeenLine& b) {
  if (a.axis == b.axis && a.axis != LineAxis::kFree) return UnitVector(a.axis);
  const Vector3d direction_a = a.Direction(), direction_b = b.Direction();
  const double sign = direction_a.dot(direction_b) < 0 ? -1 : 1;
  return (direction_a + sign * direction_b).normalized();
}

}  // namespace

std::vector<std::pair<size_t, size_t>> FindNearPairs(const std::vector<SeenLine>& lines,
                                                     double distance) {
  std::vector<AlignedBox3d> boxes;
  std::vector<size_t> upwards;  // indices by the boxes' lower z
  for (const SeenLine& line : lines) {
    upwards.push_back(boxes.size());
    boxes.push_back(BoxAround(line, 0.5 * distance + kLineDeviations * line.place_sigma));
  }
  std::stable_sort(upwards.begin(), upwards.end(), [&boxes](size_t a, size_t b) {
    return boxes[a].min().z() < boxes[b].min().z();
  });
  std::vector<std::pair<size_t, size_t>> pairs;
  std::vector<size_t> open;  // boxes that overlap the current z
  for (const size_t next : upwards) {
    const auto lies_below = [&](size_t i) { return boxes[i].max().z() < boxes[next].min().z(); };
    open.erase(std::remove_if(open.begin(), open.end(), lies_below), open.end());
    for (const size_t i : open) {
      if (boxes[i].intersects(boxes[next]))
        pairs.emplace_back(std::max(i, next), std::min(i, next));
    }
    open.push_back(next);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

LinePairGeometry Compare(const SeenLine& a, const SeenLine& b) {
  const Vector3d along = CommonDirection(a, b);
  const Vector3d between = 0.5 * (a.start_F + a.end_F - b.start_F - b.end_F);
  const Vector3d direction_a = a.Direction(), direction_b = b.Direction();
  const auto [a_low, a_high] = std::minmax({along.dot(a.start_F), along.dot(a.end_F)});
  const auto [b_low, b_high] = std::minmax({along.dot(b.start_F), along.dot(b.end_F)});
  LinePairGeometry geometry;
  geometry.angle =
      std::atan2(direction_a.cross(direction_b).norm(), std::abs(direction_a.dot(direction_b)));
  geometry.distance = (between - along * along.dot(between)).norm();
  geometry.gap = std::max(a_low, b_low) - std::min(a_high, b_high);
  geometry.angle_sigma = std::hypot(a.direction_sigma, b.direction_sigma);
  geometry.distance_sigma = std::hypot(a.place_sigma, b.place_sigma);
  return geometry;
}

}  // namespace plm_vins
