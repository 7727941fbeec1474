// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_bundle/bundle_state.h"
#include "map_bundle/imu_history.h"

namespace plm_vins {

struct BundleOptions {
  double gravity_norm = 9.81;  // [m/s^2]
  SightingNoise noise;
  int max_iterations = 15;
};

// Adjusts keyframes and landmarks over what is seen of them and what the IMU measured between
// keyframes of one world ([Campos2021]: full visual-inertial bundle adjustment). Where no
// keyframe is of a loaded map, position and heading of the first one stay. Says whether the
// equations could be solved; else nothing has moved.
bool AdjustBundle(const ImuHistory& imu, const BundleOptions& options, BundleState* bundle);

}  // namespace plm_vins
