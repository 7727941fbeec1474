// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "common/imu/imu_noise.h"
#include "map_bundle/landmark_tracks.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// A keyframe of the bundle.
struct BundleKeyframe {
  int world = 0;
  int recording = -1;  // of the IMU (ImuHistory)
  FrameState state;    // by the clock of the IMU
  FrameState start;    // the state to begin with: what nothing else determines stays there
  // As it counted when the image came. Nothing where the keyframe is of a map that was loaded: then
  // it stays where it is, and its state is that of a body which has its camera at T_B_C.
  std::optional<ImuNoise> noise;
  bool stationary = false;

  bool moves() const { return noise.has_value(); }
};

// What is adjusted: keyframes by their numbers in the map, their states in M, and what they see.
struct BundleState {
  Rigid3d T_B_C;
  std::map<int, BundleKeyframe> keyframes;
  std::vector<LandmarkTrack> landmarks;

  Rigid3d T_M_C(int keyframe) const { return keyframes.at(keyframe).state.T_W_B() * T_B_C; }
};

// Standard deviations of sightings (normalised).
struct SightingNoise {
  double followed = 0;  // of a corner that is followed
  double again = 0;     // of one that a loop matched with a landmark
};

}  // namespace plm_vins
