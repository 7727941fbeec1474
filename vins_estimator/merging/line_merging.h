// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "vins_estimator/map/line_comparison.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/state/estimate_counts.h"

namespace plm_vins {

struct MergedLines {
  LineMergingCounts counts;
  std::vector<int64_t> absorbed;  // ids of the landmarks that were merged into others
};

// Merges redundant line landmarks after triangulation ([Paper], section III.C): when the track of a
// line breaks, the line is detected again under a new id and becomes a second landmark. A line is
// merged into an older one if they are less than `limits.distance` apart in the Manhattan frame and
// if each projects onto the other's segment in the images. Beyond the paper, their directions must
// agree, they must overlap or touch along the line, no image may show them side by side, and one
// line must fit the observations of both. Where the observations constrain direction or position
// less well than the limits require, the fit decides. The older landmark takes over the
// observations of the newer one; later observations are redirected by an alias.
//
// Candidate pairs are found by bounding boxes along the axes of F, which is the Manhattan frame, or
// W while that is unknown.
MergedLines MergeLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                       LocalMap* map);

}  // namespace plm_vins
