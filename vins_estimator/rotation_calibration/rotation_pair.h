// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "vins_estimator/rotation_calibration/extrinsic_rotation.h"

namespace plm_vins {

// Measures the rotation of a camera at the newest of `frames`, which must be contiguous, from the
// last one that is 0.3 s older and in which it observes anything. `noise` is the standard deviation
// of a normalized coordinate. Returns nullopt, where it can with the reason, if the rotation is too
// small or the points do not determine it.
std::optional<RotationPair> MeasureRotationPair(const std::deque<FrameMeasurement>& frames,
                                                int camera, const ImuNoise& imu_noise, double noise,
                                                std::string* reason);

}  // namespace plm_vins
