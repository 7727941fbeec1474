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

// State of a keyframe in the bundle adjustment.
struct BundleKeyframe {
  int world = 0;
  int recording = -1;  // IMU recording (ImuHistory)
  FrameState state;    // at the IMU's timestamp
  FrameState start;    // initial state; unobservable directions stay there
  // IMU noise that was in use when the image came. nullopt for a keyframe of a loaded map: it is
  // held fixed, and its state is the body pose whose camera, at T_B_C, is the mapped one.
  std::optional<ImuNoise> noise;
  bool stationary = false;

  bool moves() const { return noise.has_value(); }
};

// Variables of the bundle adjustment: keyframe states in M, by keyframe number, and landmarks with
// their observations.
struct BundleState {
  Rigid3d T_B_C;
  std::map<int, BundleKeyframe> keyframes;
  std::vector<LandmarkTrack> landmarks;

  Rigid3d T_M_C(int keyframe) const { return keyframes.at(keyframe).state.T_W_B() * T_B_C; }
};

// Standard deviations of observations (normalized image coordinates).
struct ObservationNoise {
  double followed = 0;  // corner tracked from image to image
  double again = 0;     // corner matched with a landmark of another visit by a loop
};

}  // namespace plm_vins
