// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/keyframe_policy.h"

#include <algorithm>
#include <cstddef>

namespace plm_vins {
namespace {

struct TrackedPoints {
  int in_newest = 0;
  int in_both = 0;
  double mean_parallax = 0;
};

const PointLandmark::Observation* Find(const PointLandmark& landmark, const ImageKey& image) {
  for (auto it = landmark.observations.rbegin(); it != landmark.observations.rend(); ++it) {
    if (*it == image) return &*it;
  }
  return nullptr;
}

TrackedPoints Compare(const PointMap& points, int64_t before_ns, int64_t newest_ns) {
  TrackedPoints result;
  double sum = 0;
  for (const auto& [id, landmark] : points.landmarks()) {
    const PointLandmark::Observation& newest = landmark.observations[FirstInNewest(landmark)];
    if (newest.t_ns != newest_ns) continue;
    ++result.in_newest;
    const PointLandmark::Observation* before = Find(landmark, {before_ns, newest.camera});
    if (before == nullptr) continue;
    ++result.in_both;
    sum += (newest.bearing.xy - before->bearing.xy).norm();
  }
  if (result.in_both > 0) result.mean_parallax = sum / result.in_both;
  return result;
}

// Returns whether the newest `count` frames are all stationary.
bool RestsFor(size_t count, const SlidingWindow& window) {
  return window.frames.size() >= count &&
         std::all_of(window.frames.rbegin(), window.frames.rbegin() + count,
                     [](const WindowFrame& frame) { return frame.stationary; });
}

}  // namespace

bool IsKeyframe(const KeyframePolicyOptions& options, const SlidingWindow& window,
                const PointMap& points) {
  if (window.frames.size() < 2) return true;
  const int64_t newest_ns = window.newest().state.t_ns;
  const int64_t before_ns = window.second_newest().state.t_ns;
  const double interval = ToSeconds(newest_ns - before_ns);
  const TrackedPoints tracked = Compare(points, before_ns, newest_ns);
  if (tracked.in_newest < options.min_points_to_see) return interval > options.max_blind_interval;
  const bool at_rest = RestsFor(options.min_keyframes_at_rest + 1, window);
  const double max_interval = at_rest ? options.max_interval_at_rest : options.max_interval;
  const bool is_full = window.frames.size() >= options.window_size;
  return interval > max_interval || tracked.in_both < options.min_tracked ||
         tracked.in_both < options.min_tracked_share * tracked.in_newest ||
         (tracked.mean_parallax > options.min_parallax &&
          (!is_full || interval > options.min_interval));
}

bool EndsStandstill(const KeyframePolicyOptions& options, const SlidingWindow& window) {
  if (window.frames.size() < 3) return false;
  const WindowFrame& keyframe = window.frames[window.frames.size() - 3];
  const WindowFrame& last = window.second_newest();
  return last.stationary && !window.newest().stationary &&
         ToSeconds(last.state.t_ns - keyframe.state.t_ns) > options.max_interval;
}

}  // namespace plm_vins
