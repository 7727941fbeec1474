// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "common/config/config.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Holds the newest calibration, to be saved on request. Thread-safe: Set() does not block while
// another thread saves.
class CalibrationLog {
 public:
  explicit CalibrationLog(const Config& config) : config_(config) {}

  void Set(const Calibration& calibration);

  // Writes the configuration with the newest calibration into the folder. Has no effect if the
  // calibration is not refined, or if there was no pose yet. Throws std::runtime_error if the file
  // cannot be written, or as CheckFolder() does.
  void Save(const std::string& folder) const;

  // Throws std::runtime_error if the file in that folder is the configuration in use, which would
  // be overwritten.
  void CheckFolder(const std::string& folder) const;

 private:
  std::optional<Calibration> Newest() const;

  const Config config_;
  mutable std::mutex mutex_;
  std::optional<Calibration> newest_;
};

}  // namespace plm_vins
