// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/calibration_log.h"

#include <filesystem>

#include "vins_estimator/output/calibrated_config.h"

namespace plm_vins {

void CalibrationLog::Set(const Calibration& calibration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = calibration;
}

void CalibrationLog::Save(const std::string& folder) const {
  const std::optional<Calibration> newest = Newest();
  if (!newest || !RefinesCalibration(config_.sensor)) return;
  const std::filesystem::path file = std::filesystem::path(folder) / kCalibratedConfigFile;
  SaveCalibratedConfig(*newest, config_, file.string());
}

std::optional<Calibration> CalibrationLog::Newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

}  // namespace plm_vins
