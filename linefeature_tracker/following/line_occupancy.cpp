// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_occupancy.h"

namespace plm_vins {
namespace {

constexpr double kMaxAngle = 0.17;  // [rad]
constexpr double kMinOverlap = 0.3;

}  // namespace

bool LineOccupancy::IsTaken(const LineSegment& segment_px) const {
  return std::any_of(segments_px_.begin(), segments_px_.end(), [&](const LineSegment& other) {
    if (UndirectedAngle(other, segment_px) > kMaxAngle) return false;
    const SegmentRelation relation = Relate(other, segment_px);
    return relation.overlap > kMinOverlap && relation.distance < spacing_px_;
  });
}

}  // namespace plm_vins
