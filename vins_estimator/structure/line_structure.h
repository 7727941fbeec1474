// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/manhattan/manhattan_frame.h"
#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/state/estimate_counts.h"

namespace plm_vins {

// What became of the lines of the map in one frame.
struct UnitedLines {
  LineMergingCounts merging;
  int recognised = 0;             // that had left the window
  std::vector<int64_t> absorbed;  // ids of merged lines that are no more
};

// What the lines of the map say of the scene and of each other: the Manhattan frame that they run
// along, and which of them are one.
class LineStructure {
 public:
  explicit LineStructure(const SameLineLimits& same_line) : same_line_(same_line) {}

  // Lets the triangulated lines vote at the newest frame, and names their axes.
  void FindAxes(LocalMap* map);

  // Merges lines that are one, and those that are back with what they were (MergeLines,
  // RecogniseLines). They go on as one line, with one vote on the Manhattan frame.
  UnitedLines Unite(LocalMap* map);

  const ManhattanFrame& manhattan() const { return manhattan_; }

 private:
  SameLineLimits same_line_;
  ManhattanFrame manhattan_;
};

}  // namespace plm_vins
