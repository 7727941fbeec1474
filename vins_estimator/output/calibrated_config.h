// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

constexpr char kCalibratedConfigFile[] = "calibrated.yaml";

// Returns whether the estimator is configured to refine any of the calibration.
bool RefinesCalibration(const SensorConfig& sensor);

// Returns the configuration with the estimated calibration, clamped to what LoadConfig() accepts.
Config WithCalibration(const Calibration& calibration, Config config);

// Writes the configuration with the estimated calibration, ready to be used. Throws
// std::runtime_error if the file cannot be written.
void SaveCalibratedConfig(const Calibration& calibration, const Config& config,
                          const std::string& file);

}  // namespace plm_vins
