// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"

namespace plm_vins::simulator {

// Returns sensors similar to EuRoC's: a 752 x 480 wide-angle camera with radial distortion, whose
// image is upright if the body's x axis points up, and a tactical-grade IMU.
SensorConfig DefaultSensors();

// Returns these sensors with a second camera 0.11 m to the right.
SensorConfig DefaultStereoSensors();

}  // namespace plm_vins::simulator
