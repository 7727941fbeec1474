// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// The state of a body that stands still, from the mean of its IMU samples: roll and pitch from the
// specific force, the gyro bias from the rate; position, heading, velocity and accelerometer bias
// 0. The accelerometer bias tilts the result: 0.1 m/s^2 by 0.6 degrees. The caller knows that the
// body stands still. `t_ns` of the state is left to the caller. Nothing, and the reason in words,
// where the means cannot be those of a body at rest.
std::optional<FrameState> InitializeFromStandstill(const std::vector<ImuSample>& samples,
                                                   double gravity_norm, std::string* reason);

}  // namespace plm_vins
