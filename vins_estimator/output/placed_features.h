// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/features/placed_features.h"
#include "common/measurements.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Returns each feature, as the first camera that observes it does, together with the position of
// its landmark. A line that was merged into another landmark has no position.
std::vector<TrackedCorner> PlaceCorners(const PointFrame& frame,
                                        const std::vector<MapPoint>& landmarks);
std::vector<TrackedSegment> PlaceSegments(const LineFrame& frame,
                                          const std::vector<MapLine>& landmarks);

}  // namespace plm_vins
