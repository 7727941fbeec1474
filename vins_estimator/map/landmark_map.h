// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Base of the point and line maps: tracks with observations in frames of the window, the oldest of
// which hosts the landmark's coordinates. A Landmark has `id`, `views` (observations by time, each
// with t_ns), `triangulated`, host(), and
//   void MoveHost(const SlidingWindow&, size_t view, Landmark*)
// which transforms its coordinates to the camera of another observation, or marks it as not
// triangulated.
template <typename Landmark>
class LandmarkMap {
 public:
  // Ordered by id, so that sums over landmarks are the same in every run.
  using Landmarks = std::map<int64_t, Landmark>;

  // Removes all observations in a frame, and landmarks without any left. If the frame was the host,
  // the next observation becomes the host.
  void RemoveFrame(const SlidingWindow& window, int64_t t_ns);

  // Handles the landmarks that are marginalized with a frame (LeavesWith), whose observations must
  // not be used again: landmarks still tracked keep only their newest observation as the new host,
  // at the same position; the others are passed to `on_departure` and removed.
  void Reinitialize(const SlidingWindow& window, int64_t host_ns,
                    const std::function<void(const Landmark&)>& on_departure);

  // Removes the landmarks that satisfy `condition`.
  void RemoveIf(const std::function<bool(const Landmark&)>& condition);

  // Drops the observations in the second camera and the depths of landmarks that are not
  // triangulated.
  void ForgetUntriangulatedDepths();

  // Counts the optimized landmarks: all of them, or those observed in the newest image.
  int CountOptimized() const;
  int CountInNewest(const SlidingWindow& window) const;

  Landmarks& landmarks() { return landmarks_; }
  const Landmarks& landmarks() const { return landmarks_; }

 protected:
  Landmarks landmarks_;
};

// Counts the observations, in both cameras and of depth.
template <typename View>
int CountMeasurements(const std::vector<View>& views) {
  int count = 0;
  for (const View& view : views) count += view.CountMeasurements();
  return count;
}

// Returns whether the landmark is part of the optimization: it has enough observations to be
// overdetermined.
template <typename Landmark>
bool IsOptimized(const Landmark& landmark) {
  constexpr int kMinMeasurements = 3;
  return landmark.triangulated && landmark.views.size() > 1 &&
         CountMeasurements(landmark.views) >= kMinMeasurements;
}

// Returns whether an optimized landmark is observed in the newest image.
template <typename Landmark>
bool IsOptimizedInNewest(const Landmark& landmark, const SlidingWindow& window) {
  return IsOptimized(landmark) && landmark.views.back().t_ns == window.newest().state.t_ns;
}

// Returns whether the landmark was optimized when the keyframe was. It was not if only one of its
// observations is as old as the keyframe.
template <typename Landmark>
bool WasOptimizedAt(int64_t keyframe_ns, const Landmark& landmark) {
  return IsOptimized(landmark) && landmark.views[1].t_ns <= keyframe_ns;
}

// Returns whether the landmark is marginalized with its host frame: other frames observe it as
// well.
template <typename Landmark>
bool LeavesWith(int64_t host_ns, const Landmark& landmark) {
  return landmark.triangulated && landmark.host().t_ns == host_ns && landmark.views.size() > 1;
}

// Drops all observations in the second camera and of depth: if a landmark is wrong, they may be the
// cause, so it is triangulated again without them. Returns whether there were any.
template <typename Landmark>
bool StartWithoutDepth(Landmark* landmark) {
  if (CountMeasurements(landmark->views) == static_cast<int>(landmark->views.size())) return false;
  for (auto& view : landmark->views) view.ForgetDepth();
  landmark->triangulated = false;
  return true;
}

// Keeps a single observation of a landmark, which becomes its host.
template <typename Landmark>
void KeepOnlyView(const SlidingWindow& window, size_t view, Landmark* landmark) {
  MoveHost(window, view, landmark);
  landmark->views = {landmark->views[view]};
}

// Removes one observation of a landmark.
template <typename Landmark>
void RemoveView(const SlidingWindow& window, size_t index, Landmark* landmark) {
  const bool is_host = index == 0 && landmark->triangulated && landmark->views.size() > 1;
  if (is_host) MoveHost(window, 1, landmark);
  landmark->views.erase(landmark->views.begin() + index);
}

template <typename Landmark>
void LandmarkMap<Landmark>::RemoveFrame(const SlidingWindow& window, int64_t t_ns) {
  for (auto& [id, landmark] : landmarks_) {
    const auto view = std::find_if(landmark.views.begin(), landmark.views.end(),
                                   [t_ns](const auto& v) { return v.t_ns == t_ns; });
    if (view != landmark.views.end()) {
      RemoveView(window, view - landmark.views.begin(), &landmark);
    }
  }
  RemoveIf([](const Landmark& landmark) { return landmark.views.empty(); });
}

template <typename Landmark>
void LandmarkMap<Landmark>::Reinitialize(const SlidingWindow& window, int64_t host_ns,
                                         const std::function<void(const Landmark&)>& on_departure) {
  const int64_t newest_ns = window.newest().state.t_ns;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    Landmark& landmark = it->second;
    const bool has_gone = LeavesWith(host_ns, landmark);
    if (has_gone && landmark.views.back().t_ns != newest_ns) {
      on_departure(landmark);
      it = landmarks_.erase(it);
      continue;
    }
    if (has_gone) KeepOnlyView(window, landmark.views.size() - 1, &landmark);
    ++it;
  }
}

template <typename Landmark>
int LandmarkMap<Landmark>::CountOptimized() const {
  const auto is_optimized = [](const auto& entry) { return IsOptimized(entry.second); };
  return static_cast<int>(std::count_if(landmarks_.begin(), landmarks_.end(), is_optimized));
}

template <typename Landmark>
int LandmarkMap<Landmark>::CountInNewest(const SlidingWindow& window) const {
  const auto shows = [&window](const auto& entry) {
    return IsOptimizedInNewest(entry.second, window);
  };
  return static_cast<int>(std::count_if(landmarks_.begin(), landmarks_.end(), shows));
}

template <typename Landmark>
void LandmarkMap<Landmark>::ForgetUntriangulatedDepths() {
  for (auto& [id, landmark] : landmarks_) {
    if (!landmark.triangulated) StartWithoutDepth(&landmark);
  }
}

template <typename Landmark>
void LandmarkMap<Landmark>::RemoveIf(const std::function<bool(const Landmark&)>& condition) {
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    it = condition(it->second) ? landmarks_.erase(it) : std::next(it);
  }
}

}  // namespace plm_vins
