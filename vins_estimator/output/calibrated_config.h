// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config.h"
#include "vins_estimator/state/calibration.h"

namespace plm_vins {

constexpr char kCalibratedConfigFile[] = "calibrated.yaml";

// Whether the estimator is asked to refine anything of the calibration.
bool RefinesCalibration(const SensorConfig& sensor);

// The configuration with the calibration as it was estimated, but within what LoadConfig() takes:
// without a rolling shutter where its read-out time came out as none.
Config WithCalibration(const Calibration& calibration, Config config);

// Writes that as a file, ready to be run with. Throws std::runtime_error where it cannot be
// written.
void SaveCalibratedConfig(const Calibration& calibration, const Config& config,
                          const std::string& file);

}  // namespace plm_vins
