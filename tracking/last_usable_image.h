// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// The last image before a tracker lost nearly all tracks at once (because of a blank, covered or
// torn image). Its tracks are then followed directly into newer images, skipping those in between.
template <typename Track, typename Pyramid>
struct LastUsableImage {
  ImageSample sample;  // keeps the pixels that the pyramid may refer to
  Pyramid pyramid;
  std::vector<Track> tracks;
  double previous_dt = 0;  // interval from the previous image to this one [s]
  // Rotates directions from this image's camera frame to the newest one's; nullopt if unknown.
  std::optional<Eigen::Quaterniond> R_now_then;

  // Appends the rotation from the previous image to the newest one.
  void Rotate(const std::optional<Eigen::Quaterniond>& R_now_previous) {
    if (!R_now_previous) R_now_then.reset();
    if (R_now_then) R_now_then = (*R_now_previous * *R_now_then).normalized();
  }

  double Age(int64_t t_ns) const { return ToSeconds(t_ns - sample.t_ns); }  // [s]
};

// Maximum age [s]: by then the view has changed, or the tracker has found other features.
constexpr double kMaxUsableImageAge = 10;

// Returns whether nearly all tracks were lost in one image, if there were at least kMinTracks.
inline bool LosesTracks(size_t tracks, size_t followed) {
  constexpr size_t kMinTracks = 10;
  return tracks >= kMinTracks && 10 * followed < tracks;
}

// Returns whether a third of the tracks before the loss is found again, and more than `followed`.
inline bool RegainsTracks(size_t tracks, size_t found, size_t followed) {
  return 3 * found >= tracks && found > followed;
}

}  // namespace plm_vins
