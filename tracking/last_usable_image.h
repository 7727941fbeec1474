// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// The last image before a tracker lost its tracks at once, as by a blank, covered or torn image.
// Tracks are followed from it again, over all images in between.
template <typename Track, typename Pyramid>
struct LastUsableImage {
  ImageSample sample;  // keeps the pixels that the pyramid may refer to
  Pyramid pyramid;
  std::vector<Track> tracks;
  double previous_dt = 0;  // between this image and the one before it [s]
  // Rotates directions from this image's camera frame to the newest one's; nullopt if unknown.
  std::optional<Eigen::Quaterniond> R_now_then;

  // Takes the rotation from the previous image to the newest one.
  void Rotate(const std::optional<Eigen::Quaterniond>& R_C1_C0) {
    if (!R_C1_C0) R_now_then.reset();
    if (R_now_then) R_now_then = (*R_C1_C0 * *R_now_then).normalized();
  }

  double Age(int64_t t_ns) const { return ToSeconds(t_ns - sample.t_ns); }  // [s]
};

// After this time, the view has changed, or the tracker has found other features [s].
constexpr double kMaxUsableImageAge = 10;

// Returns whether an image that had tracks lost nearly all of them.
inline bool LosesTracks(size_t tracks, size_t followed) {
  constexpr size_t kMinTracks = 10;
  return tracks >= kMinTracks && 10 * followed < tracks;
}

// Returns whether the tracks from before the loss are found again, and are better than those since.
inline bool RegainsTracks(size_t tracks, size_t found, size_t followed) {
  return 3 * found >= tracks && found > followed;
}

}  // namespace plm_vins
