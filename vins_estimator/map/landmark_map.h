// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Base of the point and line maps: tracks with observations in images of the window, the first of
// which hosts the landmark's coordinates. A Landmark has `id`, `observations` (ordered by their
// ImageKey), `triangulated`, host(), and
//   void MoveHost(const SlidingWindow&, size_t observation, Landmark*)
// which transforms its coordinates to the camera of another observation, or marks it as not
// triangulated.
template <typename Landmark>
class LandmarkMap {
 public:
  // Ordered by id, so that sums over landmarks are the same in every run.
  using Landmarks = std::map<int64_t, Landmark>;

  // Removes all observations in a frame, and landmarks without any left. If the host was in the
  // frame, the next observation becomes the host.
  void RemoveFrame(const SlidingWindow& window, int64_t t_ns);

  // Handles the landmarks that are marginalized with a frame (LeavesWith), whose observations must
  // not be used again: landmarks still tracked keep only those in the newest frame, the first of
  // which is the new host, at the same position; the others are passed to `on_departure` and
  // removed.
  void Reinitialize(const SlidingWindow& window, int64_t host_ns,
                    const std::function<void(const Landmark&)>& on_departure);

  // Removes the landmarks that satisfy `condition`.
  void RemoveIf(const std::function<bool(const Landmark&)>& condition);

  // Removes the observations by a camera of landmarks that another camera hosts and that are not
  // triangulated.
  void DropUntriangulated(int camera);

  // Removes observations that are not hosts.
  void Remove(int64_t id, const ImageKey& image);

  // Counts the optimized landmarks: all of them, or those observed in the newest frame.
  int CountOptimized() const;
  int CountInNewest(const SlidingWindow& window) const;

  Landmarks& landmarks() { return landmarks_; }
  const Landmarks& landmarks() const { return landmarks_; }

 protected:
  Landmarks landmarks_;
};

// Removes the observations that satisfy `condition`; returns their number.
template <typename Observation, typename Condition>
size_t RemoveObservationsIf(const Condition& condition, std::vector<Observation>* observations) {
  const size_t before = observations->size();
  observations->erase(std::remove_if(observations->begin(), observations->end(), condition),
                      observations->end());
  return before - observations->size();
}

// Removes the observations in one frame.
template <typename Observation>
void RemoveObservationsIn(int64_t t_ns, std::vector<Observation>* observations) {
  RemoveObservationsIf([t_ns](const Observation& o) { return o.t_ns == t_ns; }, observations);
}

// Returns the index of the first observation in the newest of the frames that observe a landmark.
template <typename Landmark>
size_t FirstInNewest(const Landmark& landmark) {
  size_t first = landmark.observations.size() - 1;
  const int64_t t_ns = landmark.observations[first].t_ns;
  while (first > 0 && landmark.observations[first - 1].t_ns == t_ns) --first;
  return first;
}

// Returns the observations by the host's camera: those of one track.
template <typename Landmark>
std::vector<typename Landmark::Observation> OfHostCamera(const Landmark& landmark) {
  std::vector<typename Landmark::Observation> observations = landmark.observations;
  const int camera = landmark.host().camera;
  RemoveObservationsIf([camera](const ImageKey& image) { return image.camera != camera; },
                       &observations);
  return observations;
}

// Counts the measurements: observations and depths.
template <typename Observation>
int CountMeasurements(const std::vector<Observation>& observations) {
  int count = 0;
  for (const Observation& observation : observations) count += observation.CountMeasurements();
  return count;
}

// Returns whether several frames observe the landmark.
template <typename Landmark>
bool IsInSeveralFrames(const Landmark& landmark) {
  return landmark.observations.front().t_ns != landmark.observations.back().t_ns;
}

// Returns whether the landmark is part of the optimization: it has enough observations to be
// overdetermined.
template <typename Landmark>
bool IsOptimized(const Landmark& landmark) {
  constexpr int kMinMeasurements = 3;
  return landmark.triangulated && IsInSeveralFrames(landmark) &&
         CountMeasurements(landmark.observations) >= kMinMeasurements;
}

// Returns whether an optimized landmark is observed in the newest frame.
template <typename Landmark>
bool IsOptimizedInNewest(const Landmark& landmark, const SlidingWindow& window) {
  return IsOptimized(landmark) && landmark.observations.back().t_ns == window.newest().state.t_ns;
}

// Returns whether the landmark was optimized when the keyframe was. It was not if only one frame
// that observes it is as old as the keyframe.
template <typename Landmark>
bool WasOptimizedAt(int64_t keyframe_ns, const Landmark& landmark) {
  const auto is_in_second_frame = [&landmark](const ImageKey& image) {
    return image.t_ns != landmark.host().t_ns;
  };
  return IsOptimized(landmark) && std::find_if(landmark.observations.begin(),
                                               landmark.observations.end(), is_in_second_frame)
                                          ->t_ns <= keyframe_ns;
}

// Returns whether the landmark is marginalized with its host frame: other frames observe it as
// well.
template <typename Landmark>
bool LeavesWith(int64_t host_ns, const Landmark& landmark) {
  return landmark.triangulated && landmark.host().t_ns == host_ns && IsInSeveralFrames(landmark);
}

// Returns whether anything but the host's track measures the landmark: other cameras, or depths.
template <typename Landmark>
bool MeasuresDepth(const Landmark& landmark) {
  return std::any_of(landmark.observations.begin(), landmark.observations.end(),
                     [camera = landmark.host().camera](const auto& observation) {
                       return observation.camera != camera || observation.CountMeasurements() > 1;
                     });
}

// Drops what measures the depth in single frames, observations by other cameras than the host's and
// measured depths: if a landmark is wrong, they may be the cause, so it is triangulated again
// without them. Returns whether there were any.
template <typename Landmark>
bool StartWithoutDepth(Landmark* landmark) {
  if (!MeasuresDepth(*landmark)) return false;
  landmark->observations = OfHostCamera(*landmark);
  for (auto& observation : landmark->observations) observation.ForgetDepth();
  landmark->triangulated = false;
  return true;
}

// Removes the first observations of a landmark, so that the given one becomes the host.
template <typename Landmark>
void RemoveBefore(const SlidingWindow& window, size_t new_host, Landmark* landmark) {
  if (landmark->triangulated) MoveHost(window, new_host, landmark);
  landmark->observations.erase(landmark->observations.begin(),
                               landmark->observations.begin() + new_host);
}

// Keeps the observations in the newest frame only, the first of which becomes the host.
template <typename Landmark>
void KeepNewestFrame(const SlidingWindow& window, Landmark* landmark) {
  RemoveBefore(window, FirstInNewest(*landmark), landmark);
}

template <typename Landmark>
void LandmarkMap<Landmark>::RemoveFrame(const SlidingWindow& window, int64_t t_ns) {
  for (auto& [id, landmark] : landmarks_) {
    auto& observations = landmark.observations;
    size_t others = 0;
    while (others < observations.size() && observations[others].t_ns == t_ns) ++others;
    if (others > 0 && others < observations.size()) {
      RemoveBefore(window, others, &landmark);
    } else {
      RemoveObservationsIn(t_ns, &observations);
    }
  }
  RemoveIf([](const Landmark& landmark) { return landmark.observations.empty(); });
}

template <typename Landmark>
void LandmarkMap<Landmark>::Reinitialize(const SlidingWindow& window, int64_t host_ns,
                                         const std::function<void(const Landmark&)>& on_departure) {
  const int64_t newest_ns = window.newest().state.t_ns;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    Landmark& landmark = it->second;
    const bool has_gone = LeavesWith(host_ns, landmark);
    if (has_gone && landmark.observations.back().t_ns != newest_ns) {
      on_departure(landmark);
      it = landmarks_.erase(it);
      continue;
    }
    if (has_gone) KeepNewestFrame(window, &landmark);
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
void LandmarkMap<Landmark>::DropUntriangulated(int camera) {
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.triangulated || landmark.host().camera == camera) continue;
    RemoveObservationsIf([camera](const ImageKey& image) { return image.camera == camera; },
                         &landmark.observations);
  }
}

template <typename Landmark>
void LandmarkMap<Landmark>::Remove(int64_t id, const ImageKey& image) {
  RemoveObservationsIf([&image](const ImageKey& other) { return other == image; },
                       &landmarks_.at(id).observations);
}

template <typename Landmark>
void LandmarkMap<Landmark>::RemoveIf(const std::function<bool(const Landmark&)>& condition) {
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    it = condition(it->second) ? landmarks_.erase(it) : std::next(it);
  }
}

}  // namespace plm_vins
