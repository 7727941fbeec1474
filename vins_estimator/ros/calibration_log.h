// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "common/config/config.h"
#include "vins_estimator/state/calibration.h"

namespace plm_vins {

// The newest calibration, to be saved on request. For several threads: Set() does not wait while
// another one saves.
class CalibrationLog {
 public:
  explicit CalibrationLog(const Config& config) : config_(config) {}

  void Set(const Calibration& calibration);

  // Writes the configuration with this calibration into the folder, where the configuration has it
  // refined and there was a pose. Throws std::runtime_error where that cannot be written, and as
  // CheckFolder().
  void Save(const std::string& folder) const;

  // Throws std::runtime_error where the file in that folder is the configuration in use, which
  // would be lost.
  void CheckFolder(const std::string& folder) const;

 private:
  std::optional<Calibration> Newest() const;

  const Config config_;
  mutable std::mutex mutex_;
  std::optional<Calibration> newest_;
};

}  // namespace plm_vins
