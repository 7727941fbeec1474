// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Initializes the state at standstill from the mean of the IMU samples: roll and pitch from the
// specific force, the gyroscope bias from the rate; position, heading, velocity and accelerometer
// bias are zero. The true accelerometer bias tilts the result: 0.1 m/s^2 by 0.6 deg. The caller
// must know that the body stands still, and sets `t_ns` of the state. Returns nullopt, with the
// reason, if the means are impossible at standstill.
std::optional<FrameState> InitializeFromStandstill(const std::vector<ImuSample>& samples,
                                                   double gravity_norm, std::string* reason);

// Returns by how much the mean specific force exceeds gravity [m/s^2]: at standstill, the part of
// the accelerometer's bias along gravity, and a lower bound on its size.
double ExcessOfGravity(const std::vector<ImuSample>& samples, double gravity_norm);

}  // namespace plm_vins
