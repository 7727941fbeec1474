// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "offline/arguments.h"

namespace plm_vins {

// Throws std::runtime_error with the option if an output would overwrite an input or another
// output. A map may be read and written back.
void CheckOutputs(const Arguments& arguments);

// Throws std::runtime_error if the refined calibration would overwrite the configuration.
void CheckCalibrationOutput(const Arguments& arguments, const SensorConfig& sensor);

}  // namespace plm_vins
