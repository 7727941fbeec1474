// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace plm_vins {

// A directed segment, either in the raw image [px] or in the normalized, undistorted image plane;
// names of the former end in _px.
struct LineSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();

  double Length() const { return (end - start).norm(); }
  Eigen::Vector2d Direction() const { return (end - start).normalized(); }
  Eigen::Vector2d Normal() const {
    const Eigen::Vector2d direction = Direction();
    return {-direction.y(), direction.x()};
  }
  Eigen::Vector2d Midpoint() const { return 0.5 * (start + end); }

  // Signed distance of the point from the infinite line, positive on the side of Normal().
  double Distance(const Eigen::Vector2d& point) const { return Normal().dot(point - start); }
  // Position of the point's projection along the line; 0 at `start`, Length() at `end`.
  double Along(const Eigen::Vector2d& point) const { return Direction().dot(point - start); }

  LineSegment Reversed() const { return {end, start}; }
};

// Angle between the directions, 0 to pi.
inline double DirectedAngle(const LineSegment& a, const LineSegment& b) {
  const Eigen::Vector2d u = a.end - a.start;
  const Eigen::Vector2d v = b.end - b.start;
  return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
}

// Relative position of two segments, measured along and across the first one.
struct SegmentRelation {
  double overlap = 0;   // shared length relative to the shorter segment; negative for a gap
  double distance = 0;  // across the first one, at the middle of the shared part
};

inline SegmentRelation Relate(const LineSegment& a, const LineSegment& b) {
  double from = a.Along(b.start);
  double to = a.Along(b.end);
  double distance_from = a.Distance(b.start);
  double distance_to = a.Distance(b.end);
  if (from > to) {
    std::swap(from, to);
    std::swap(distance_from, distance_to);
  }
  const double low = std::max(from, 0.0);
  const double high = std::min(to, a.Length());
  const double span = std::max(to - from, 1e-12);
  const double middle = std::clamp((0.5 * (low + high) - from) / span, 0.0, 1.0);
  return {(high - low) / std::max(std::min(to - from, a.Length()), 1e-12),
          std::abs(distance_from + middle * (distance_to - distance_from))};
}

// Signed distance of a line from a segment, positive on the side of its Normal() (normalized).
struct LineOffset {
  double at_start = 0;
  double slope = 0;  // change along the segment

  // `along` is measured from the segment's start.
  double At(double along) const { return at_start + slope * along; }
};

// Returns the segment moved by the offset.
inline LineSegment Shifted(const LineSegment& segment, const LineOffset& offset) {
  const Eigen::Vector2d normal = segment.Normal();
  return {segment.start + offset.at_start * normal,
          segment.end + offset.At(segment.Length()) * normal};
}

}  // namespace plm_vins
