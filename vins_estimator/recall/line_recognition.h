// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/local_map.h"

namespace plm_vins {

// Finds the lines of the map that have been there before: a line is one of the memory where they
// are as near each other in space as lines that merge (MergeLines), in directions and distances of
// a frame F, and where all its views show it in that place. It goes on under the older id, and what
// anchors have seen of it counts as well: this ties the window to where the line was seen first.
// Returns the ids that are no more.
std::vector<int64_t> RecogniseLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                                    LocalMap* map);

}  // namespace plm_vins
