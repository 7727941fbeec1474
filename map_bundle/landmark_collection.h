// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map_bundle/bundle_state.h"
#include "map_bundle/landmark_tracks.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Collects the landmarks that have enough parallax and positive depth in each observing camera,
// ordered by key. The states of all keyframes in the map must be set.
std::vector<LandmarkTrack> CollectLandmarks(const KeyframeMap& map, const BundleState& bundle,
                                            const std::vector<Reobservation>& again);

}  // namespace plm_vins
