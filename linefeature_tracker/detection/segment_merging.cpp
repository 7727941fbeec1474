// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/segment_merging.h"

#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace plm_vins {
namespace {

// Spatial index of the endpoints of all segments.
class EndGrid {
 public:
  EndGrid(const std::vector<LineSegment>& segments, double cell_size) : cell_size_(cell_size) {
    for (size_t i = 0; i < segments.size(); ++i) {
      cells_[Key(Cell(segments[i].start.x()), Cell(segments[i].start.y()))].push_back(i);
      cells_[Key(Cell(segments[i].end.x()), Cell(segments[i].end.y()))].push_back(i);
    }
  }

  // Calls visit(i) for each segment with an endpoint in the cells around the point.
  template <typename Visitor>
  void VisitAround(const Eigen::Vector2d& point, const Visitor& visit) const {
    const int64_t column = Cell(point.x());
    const int64_t row = Cell(point.y());
    for (int64_t y = row - 1; y <= row + 1; ++y) {
      for (int64_t x = column - 1; x <= column + 1; ++x) {
        const auto it = cells_.find(Key(x, y));
        if (it == cells_.end()) continue;
        for (const size_t i : it->second) visit(i);
      }
    }
  }

 private:
  int64_t Cell(double coordinate) const {
    return static_cast<int64_t>(std::floor(coordinate / cell_size_));
  }
  static int64_t Key(int64_t column, int64_t row) { return row * (int64_t{1} << 32) + column; }

  double cell_size_;
  std::unordered_map<int64_t, std::vector<size_t>> cells_;
};

// Returns whether `other` continues the segment at its end.
bool Continues(const LineSegment& segment, const LineSegment& other,
               const SegmentMergingLimits& limits) {
  return (other.start - segment.end).norm() <= limits.gap &&
         segment.Along(other.end) > segment.Length() &&
         DirectedAngle(segment, other) <= limits.angle &&
         std::abs(segment.Distance(other.start)) <= limits.distance &&
         std::abs(segment.Distance(other.end)) <= limits.distance;
}

// Extends the segment at its end while unused fragments continue it; `reversed` reverses the
// fragments.
LineSegment ExtendEnd(LineSegment segment, bool reversed, const std::vector<LineSegment>& fragments,
                      const EndGrid& grid, const SegmentMergingLimits& limits,
                      std::vector<bool>* used) {
  while (true) {
    std::optional<size_t> best;
    Eigen::Vector2d best_end = segment.end;
    grid.VisitAround(segment.end, [&](size_t i) {
      if ((*used)[i]) return;
      const LineSegment other = reversed ? fragments[i].Reversed() : fragments[i];
      if (!Continues(segment, other, limits)) return;
      if (best && segment.Along(other.end) <= segment.Along(best_end)) return;
      best = i;
      best_end = other.end;
    });
    if (!best) return segment;
    (*used)[*best] = true;
    segment.end = best_end;
  }
}

}  // namespace

std::vector<LineSegment> JoinFragments(const std::vector<LineSegment>& segments,
                                       const SegmentMergingLimits& limits) {
  std::vector<size_t> order(segments.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return segments[a].Length() > segments[b].Length(); });
  const EndGrid grid(segments, limits.gap);
  std::vector<bool> used(segments.size(), false);
  std::vector<LineSegment> joined;
  for (const size_t i : order) {
    if (used[i]) continue;
    used[i] = true;
    const LineSegment ahead = ExtendEnd(segments[i], false, segments, grid, limits, &used);
    joined.push_back(ExtendEnd(ahead.Reversed(), true, segments, grid, limits, &used).Reversed());
  }
  return joined;
}

}  // namespace plm_vins
