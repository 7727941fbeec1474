// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/imu/imu_noise.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

namespace plm_vins {

// Estimates the noise of the IMU from the solved windows and applies it to their intervals.
class ImuNoiseLearning {
 public:
  explicit ImuNoiseLearning(const ImuNoise& configured) : estimate_(configured) {}

  // Adds the intervals that were not used yet: those in the older half of the window, which images
  // on both sides constrain best, or all of the first window. `equations` are those of the
  // solution.
  void Learn(const SlidingWindow& window, bool is_first, NormalEquations* equations);

  // Re-integrates intervals whose assumed noise is far too low. Returns false if there are none.
  bool Reweigh(SlidingWindow* window) const;

  void Reset() { *this = ImuNoiseLearning(estimate_.configured()); }

  ImuNoise noise() const { return estimate_.noise(); }

 private:
  ImuNoiseEstimate estimate_;
  std::optional<int64_t> known_ns_;  // start of the newest interval that was used
};

}  // namespace plm_vins
