// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_bundle/bundle_state.h"
#include "map_bundle/imu_history.h"

namespace plm_vins {

struct BundleOptions {
  double gravity_norm = 9.81;  // [m/s^2]
  ObservationNoise noise;
  double depth_noise = 0;  // deviation of a measured inverse depth, if there are any [1/m]
  int max_iterations = 15;
};

// Jointly optimizes keyframe states and landmarks over the observations of all cameras and the
// preintegrated IMU between keyframes of one world ([Campos2021]: full visual-inertial bundle
// adjustment). Position and heading of the first keyframe are held fixed if no keyframe belongs to
// a loaded map. Returns false, and changes nothing, if the solver fails.
bool AdjustBundle(const ImuHistory& imu, const BundleOptions& options, BundleState* bundle);

}  // namespace plm_vins
