// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/local_map.h"

namespace plm_vins {

// Recognizes lines of the map that were observed before. A landmark matches a remembered line if
// they are close enough to be merged (MergeLines), in directions and distances of a frame F, and
// all its observations agree with that line. It continues with the older id and the observations by
// anchors, which constrains the window to where the line was first observed. Returns the ids that
// no longer exist.
std::vector<int64_t> RecognizeLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                                    LocalMap* map);

}  // namespace plm_vins
