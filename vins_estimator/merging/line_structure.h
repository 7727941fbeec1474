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

// Merged and recognized lines of the map at one frame.
struct UnitedLines {
  LineMergingCounts merging;
  int recognized = 0;             // lines re-observed after they had left the window
  std::vector<int64_t> absorbed;  // ids of lines that were merged into others
};

// Finds structure among the line landmarks: the Manhattan frame that they are parallel to, and
// which of them are observations of one line.
class LineStructure {
 public:
  explicit LineStructure(const SameLineLimits& same_line) : same_line_(same_line) {}

  // Lets the triangulated lines vote at the newest frame and labels their axes.
  void FindAxes(LocalMap* map);

  // Merges duplicate lines (MergeLines) and recognizes re-observed ones (RecognizeLines). Merged
  // lines continue as one landmark with one vote on the Manhattan frame.
  UnitedLines Unite(LocalMap* map);

  const ManhattanFrame& manhattan() const { return manhattan_; }

 private:
  SameLineLimits same_line_;
  ManhattanFrame manhattan_;
};

}  // namespace plm_vins
