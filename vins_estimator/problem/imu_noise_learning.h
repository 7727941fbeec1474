// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/imu/imu_noise.h"
#include "vins_estimator/imu/imu_noise_estimate.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/normal_equations.h"

namespace plm_vins {

// Finds the noise of the IMU in the windows that are solved, and gives it to their intervals.
class ImuNoiseLearning {
 public:
  explicit ImuNoiseLearning(const ImuNoise& configured) : estimate_(configured) {}

  // Takes in the intervals of the older half of the window but for those that it knows: images on
  // both sides tell them best. All of them where the window is the first. `equations` are those of
  // the solution.
  void Learn(const SlidingWindow& window, bool is_first, NormalEquations* equations);

  // Integrates the intervals anew that count as far less noisy than is known now. False where there
  // are none.
  bool Reweigh(SlidingWindow* window) const;

  void Reset() { *this = ImuNoiseLearning(estimate_.configured()); }

  ImuNoise noise() const { return estimate_.noise(); }

 private:
  ImuNoiseEstimate estimate_;
  std::optional<int64_t> known_ns_;  // begin of the newest interval that was taken in
};

}  // namespace plm_vins
