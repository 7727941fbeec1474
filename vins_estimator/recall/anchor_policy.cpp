// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/recall/anchor_policy.h"

#include <algorithm>

#include "common/measurements.h"

namespace plm_vins {
namespace {

bool LinesDepart(const SlidingWindow& window, const LineMap& lines) {
  const int64_t oldest_ns = window.frames.front().state.t_ns;
  const int64_t newest_ns = window.newest().state.t_ns;
  return std::any_of(lines.landmarks().begin(), lines.landmarks().end(), [&](const auto& item) {
    return LeavesWith(oldest_ns, item.second) && item.second.observations.back().t_ns != newest_ns;
  });
}

bool SeesTheSame(const AnchorPolicyOptions& options, const FrameState& a, const FrameState& b) {
  return (a.position() - b.position()).norm() < options.max_distance &&
         a.rotation().angularDistance(b.rotation()) < options.max_angle;
}

}  // namespace

bool StaysAsAnchor(const AnchorPolicyOptions& options, const SlidingWindow& window,
                   const LineMap& lines) {
  if (options.max_anchors == 0 || !LinesDepart(window, lines)) return false;
  const FrameState& oldest = window.frames.front().state;
  const int64_t newest_ns = window.newest().state.t_ns;
  return std::none_of(window.anchors.begin(), window.anchors.end(), [&](const AnchorFrame& anchor) {
    return ToSeconds(newest_ns - anchor.last_use_ns) <= options.max_idle &&
           SeesTheSame(options, anchor.state, oldest);
  });
}

std::optional<int64_t> AnchorToReplace(const AnchorPolicyOptions& options,
                                       const SlidingWindow& window) {
  if (window.anchors.size() < options.max_anchors) return std::nullopt;
  return std::min_element(window.anchors.begin(), window.anchors.end(),
                          [](const AnchorFrame& a, const AnchorFrame& b) {
                            return a.last_use_ns < b.last_use_ns;
                          })
      ->state.t_ns;
}

void NoteUse(const LineMap& lines, SlidingWindow* window) {
  for (const auto& [id, landmark] : lines.landmarks()) {
    for (const LineLandmark::Observation& observation : landmark.anchor_observations) {
      window->AnchorAt(observation.t_ns).last_use_ns = window->newest().state.t_ns;
    }
  }
}

}  // namespace plm_vins
