// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "offline/arguments.h"

namespace plm_vins {

// An input would be lost where an output takes its place, and so would one of two outputs. Throws
// std::runtime_error that names the option where that is so. But a map may be continued.
void CheckOutputs(const Arguments& arguments);

// The same of the configuration, where the calibration that is found would take its place.
void CheckCalibrationOutput(const Arguments& arguments, const SensorConfig& sensor);

}  // namespace plm_vins
