// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/calibrated_config.h"

#include "common/config/config_keys.h"
#include "common/config/config_writer.h"
#include "common/io/output_file.h"

namespace plm_vins {

using ExtrinsicMode = SensorConfig::ExtrinsicMode;

bool RefinesCalibration(const SensorConfig& sensor) {
  return sensor.estimate_intrinsics || sensor.estimate_td ||
         sensor.estimate_extrinsic != ExtrinsicMode::kFixed || sensor.cameras.size() > 1;
}

Config WithCalibration(const Calibration& calibration, Config config) {
  SensorConfig& sensor = config.sensor;
  for (size_t i = 0; i < sensor.cameras.size(); ++i) {
    sensor.cameras[i].parameters = calibration.cameras[i].parameters;
    sensor.cameras[i].T_B_C = calibration.cameras[i].T_B_C;
  }
  sensor.td = calibration.td;
  // The rotation is known now, so it only needs refinement.
  if (sensor.estimate_extrinsic == ExtrinsicMode::kCalibrateRotation) {
    sensor.estimate_extrinsic = ExtrinsicMode::kRefine;
  }
  KeepInRange(&config);
  return config;
}

void SaveCalibratedConfig(const Calibration& calibration, const Config& config,
                          const std::string& file) {
  ReplacedFile output(file);  // may be the file that the program was started with
  WriteConfig(WithCalibration(calibration, config), &output.stream());
  output.Commit();
}

}  // namespace plm_vins
