// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "common/config/estimator_config.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

struct KeyframePolicyOptions {
  // `focal_length` [px] converts pixels to normalized coordinates.
  KeyframePolicyOptions(const EstimatorConfig& config, double focal_length)
      : window_size(config.window_size), min_parallax(config.keyframe_parallax / focal_length) {}

  size_t window_size;

  double min_parallax;             // mean corner motion that makes a keyframe, normalized
  int min_tracked = 20;            // keyframe if fewer corners of the last keyframe are tracked
  double min_tracked_share = 0.5;  // keyframe if a smaller share of the image's corners is old
  // Shortest interval after which motion alone makes a keyframe once the window is full [s]: closer
  // ones would shorten the time that it spans.
  double min_interval = 0.08;
  int min_points_to_see = 10;  // an image with fewer corners is blind
  double max_interval = 1.0;   // longest interval between keyframes in motion [s]
  // Longest interval at standstill [s], once at least `min_keyframes_at_rest` keyframes are
  // stationary: without parallax, more of them would only push out the keyframes that constrain the
  // depths.
  double max_interval_at_rest = 10.0;
  size_t min_keyframes_at_rest = 3;
  double max_blind_interval = 3.0;  // longest interval between blind images [s]
};

// Returns whether the newest frame differs enough from the previous one to become a keyframe when
// the next image arrives. Must be called before that image is added.
bool IsKeyframe(const KeyframePolicyOptions& options, const SlidingWindow& window,
                const PointMap& points);

// Returns whether the frame before the newest one ends a standstill in which keyframes were put
// off. It must become a keyframe: otherwise the IMU would have to bridge the whole standstill. To
// be called once the newest frame is added and known to be stationary or not.
bool EndsStandstill(const KeyframePolicyOptions& options, const SlidingWindow& window);

}  // namespace plm_vins
