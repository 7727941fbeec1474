// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_occupancy.h"

namespace plm_vins {
namespace {

constexpr double kMaxTangent = 0.172;  // of the angle between nearly parallel lines: 10 deg
constexpr double kMinOverlap = 0.3;

bool AreNearlyParallel(const LineSegment& a, const LineSegment& b) {
  const Eigen::Vector2d u = a.end - a.start, v = b.end - b.start;
  return std::abs(u.x() * v.y() - u.y() * v.x()) <= kMaxTangent * std::abs(u.dot(v));
}

}  // namespace

bool LineOccupancy::IsTaken(const LineSegment& segment_px) const {
  return std::any_of(segments_px_.begin(), segments_px_.end(), [&](const LineSegment& other) {
    if (!AreNearlyParallel(other, segment_px)) return false;
    const SegmentRelation relation = Relate(other, segment_px);
    return relation.overlap > kMinOverlap && relation.distance < spacing_px_;
  });
}

}  // namespace plm_vins
