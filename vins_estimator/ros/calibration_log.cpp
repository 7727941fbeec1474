// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/calibration_log.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "vins_estimator/output/calibrated_config.h"

namespace plm_vins {
namespace {

std::string FileIn(const std::string& folder) {
  return (std::filesystem::path(folder) / kCalibratedConfigFile).string();
}

}  // namespace

void CalibrationLog::Set(const Calibration& calibration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = calibration;
}

void CalibrationLog::Save(const std::string& folder) const {
  const std::optional<Calibration> newest = Newest();
  if (!newest || !RefinesCalibration(config_.sensor)) return;
  CheckFolder(folder);
  SaveCalibratedConfig(*newest, config_, FileIn(folder));
}

void CalibrationLog::CheckFolder(const std::string& folder) const {
  if (!RefinesCalibration(config_.sensor)) return;
  std::error_code error;  // set if there is no such file
  if (!std::filesystem::equivalent(FileIn(folder), config_.file, error)) return;
  throw std::runtime_error(FileIn(folder) +
                           " is the configuration in use and is not overwritten: set "
                           "trajectory_file to a path in another folder");
}

std::optional<Calibration> CalibrationLog::Newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

}  // namespace plm_vins
