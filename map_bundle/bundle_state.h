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

// Observation of a keyframe that the map may not keep: by another camera than the first, or with a
// measured depth.
struct KeyframeObservation {
  int64_t track = -1;
  int camera = 0;
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalized
  std::optional<double> depth = {};              // [m]
  std::optional<Eigen::Vector3d> p_O = {};       // landmark position, if triangulated [m]
};

// State of a keyframe in the bundle adjustment.
struct BundleKeyframe {
  int world = 0;
  int recording = -1;  // IMU recording (ImuHistory)
  FrameState state;    // at the IMU's timestamp
  FrameState start;    // initial state; unobservable directions stay there
  // IMU noise that was in use when the image came. nullopt for a keyframe of a loaded map: it is
  // held fixed, and its state is the body pose whose first camera is the mapped one.
  std::optional<ImuNoise> noise;
  bool stationary = false;
  std::vector<KeyframeObservation> observations;  // by track and camera

  bool moves() const { return noise.has_value(); }
};

// Longer intervals between keyframes have no IMU factor, since positions drift too far in them.
constexpr int64_t kLongestMotion_ns = 10'000'000'000;

// Returns whether an IMU factor connects two keyframes that follow each other.
inline bool HasMotionBetween(const BundleKeyframe& from, const BundleKeyframe& to) {
  return from.moves() && to.moves() && from.world == to.world && from.recording == to.recording &&
         to.state.t_ns - from.state.t_ns <= kLongestMotion_ns;
}

// Variables of the bundle adjustment: keyframe states in M, by keyframe number, and landmarks with
// their observations. Extrinsics are held fixed.
struct BundleState {
  std::vector<Rigid3d> T_B_C{Rigid3d()};  // by camera
  std::map<int, BundleKeyframe> keyframes;
  std::vector<LandmarkTrack> landmarks;

  Rigid3d T_M_C(int keyframe, int camera) const {
    return keyframes.at(keyframe).state.T_W_B() * T_B_C[camera];
  }
};

// Standard deviations of observations (normalized image coordinates).
struct ObservationNoise {
  double followed = 0;  // corner tracked from image to image
  double matched = 0;   // corner matched in another camera than the host's
  double again = 0;     // corner matched with a landmark of another visit by a loop

  double Of(const LandmarkTrack::Observation& observation,
            const LandmarkTrack::Observation& host) const {
    if (observation.again) return again;
    return observation.camera == host.camera ? followed : matched;
  }
};

}  // namespace plm_vins
