// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"

namespace plm_vins::simulator {

// A rig like EuRoC's: 752 x 480 wide-angle camera with radial distortion, its image upright where
// the body's x axis points up, and a tactical-grade IMU.
SensorConfig DefaultSensors();

}  // namespace plm_vins::simulator
