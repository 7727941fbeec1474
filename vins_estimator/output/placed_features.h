// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/features/placed_features.h"
#include "common/measurements.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// The features of an image with the places of their landmarks. A line that goes on under the id of
// another landmark has none.
std::vector<TrackedCorner> PlaceCorners(const PointFrame& frame,
                                        const std::vector<MapPoint>& landmarks);
std::vector<TrackedSegment> PlaceSegments(const LineFrame& frame,
                                          const std::vector<MapLine>& landmarks);

}  // namespace plm_vins
