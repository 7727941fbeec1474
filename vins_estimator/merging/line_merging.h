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
  std::vector<int64_t> absorbed;  // ids that are no more
};

// Deletes redundant line landmarks after triangulation ([Paper], section III.C): when the track of
// a line breaks, it comes back under a new id and would be one more landmark. A line is absorbed by
// an older one where, in the Manhattan frame, they are less than `limits.distance` apart, and where
// in the images, too, each lies on the other. Beyond the paper, they must have the same direction,
// and overlap or touch along it; no image may show them side by side; and the views of both must
// fit one line. Where the views determine direction or place less well than the limits, the fit
// decides. The views of the newer go to the older, and later ones follow by way of its alias.
//
// Pairs are found by boxes along the axes of F: the Manhattan frame, or W where there is none.
MergedLines MergeLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                       LocalMap* map);

}  // namespace plm_vins
