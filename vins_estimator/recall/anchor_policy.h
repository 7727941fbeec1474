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
  // Without merging no line comes back, so that none needs an anchor.
  explicit AnchorPolicyOptions(const EstimatorConfig& config)
      : max_anchors(config.line_merging ? static_cast<size_t>(config.line_anchors) : 0) {}

  size_t max_anchors;
  double max_distance = 0.7;    // an anchor in use serves frames this near ... [m]
  double max_angle = M_PI / 7;  // ... and so little turned (26 deg) [rad]
  double max_idle = 3.0;        // an anchor without use for so long is not in use [s]
};

// Whether the oldest frame, about to leave the window, is to stay as an anchor: lines leave the
// estimate with it, and no anchor in use has about the same view.
bool StaysAsAnchor(const AnchorPolicyOptions& options, const SlidingWindow& window,
                   const LineMap& lines);

// The anchor that has to go for another: the one that was of no use for longest. Nothing while
// there is room.
std::optional<int64_t> AnchorToReplace(const AnchorPolicyOptions& options,
                                       const SlidingWindow& window);

// Notes which anchors the newest frame makes use of: those that saw a line of the estimate.
void NoteUse(const LineMap& lines, SlidingWindow* window);

}  // namespace plm_vins
