// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "common/config/estimator_config.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

struct KeyframePolicyOptions {
  // `focal_length` [px] turns pixels into normalised coordinates.
  KeyframePolicyOptions(const EstimatorConfig& config, double focal_length)
      : min_parallax(config.keyframe_parallax / focal_length) {}

  double min_parallax;             // mean motion of corners that makes a keyframe [normalised]
  int min_tracked = 20;            // fewer corners left from the last keyframe make one
  double min_tracked_share = 0.5;  // ... or a smaller share of the image's corners
  int min_points_to_see = 10;      // an image with fewer corners is blind, and seldom a keyframe
  double max_interval = 1.0;       // a keyframe at least this often while the camera sees [s]
  // ... but less often at rest [s], once that many keyframes know of it: without parallax they push
  // those out that know the depths.
  double max_interval_at_rest = 10.0;
  size_t min_keyframes_at_rest = 3;
  double max_blind_interval = 3.0;  // ... and this often while it is blind [s]
};

// Whether the newest frame adds enough to the one before it to stay in the window as a keyframe
// once the next image is there. Must be asked before that image is added.
bool IsKeyframe(const KeyframePolicyOptions& options, const SlidingWindow& window,
                const PointMap& points);

}  // namespace plm_vins
