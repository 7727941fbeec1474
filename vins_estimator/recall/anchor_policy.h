// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/config/estimator_config.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

struct AnchorPolicyOptions {
  // Lines are recognized only if merging is enabled, so otherwise there are no anchors.
  explicit AnchorPolicyOptions(const EstimatorConfig& config)
      : max_anchors(config.line_merging ? static_cast<size_t>(config.line_anchors) : 0) {}

  size_t max_anchors;
  double max_distance = 0.7;    // between cameras with similar views [m]
  double max_angle = M_PI / 7;  // between cameras with similar views, 26 deg [rad]
  double max_idle = 3.0;        // an anchor not used for longer is inactive [s]
};

// Returns whether the oldest frame, about to leave the window, becomes an anchor: lines leave the
// window with it, and no active anchor has a similar view.
bool StaysAsAnchor(const AnchorPolicyOptions& options, const SlidingWindow& window,
                   const LineMap& lines);

// Returns the anchor to evict (least recently used); nullopt while there is room.
std::optional<int64_t> AnchorToReplace(const AnchorPolicyOptions& options,
                                       const SlidingWindow& window);

// Marks the anchors that observed a line of the newest frame as used.
void NoteUse(const LineMap& lines, SlidingWindow* window);

}  // namespace plm_vins
