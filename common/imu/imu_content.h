// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "common/measurements.h"

namespace plm_vins {

// Detects samples that no working IMU sends as specific force [m/s^2] and angular rate [rad/s]:
// missing, stuck or alternating sensors, other units, removed gravity. Considers about the last ten
// seconds of all samples, before any is dropped or corrected.
class ImuContent {
 public:
  static constexpr int kTestCount = 15;

  explicit ImuContent(double gravity_norm) : gravity_norm_(gravity_norm) {}

  void Add(const ImuSample& sample);

  // Returns what the samples of `topic` show, and what to do. Returns an empty string if they are
  // plausible or too few.
  std::string Finding(const std::string& topic) const;

 private:
  const double gravity_norm_;  // [m/s^2]
  int64_t samples_ = 0;
  int64_t first_ns_ = 0, newest_ns_ = 0;
  ImuSample last_;
  // Exponentially forgetting numbers of samples that a test applies to, and of wrong ones.
  std::array<double, kTestCount> samples_of_ = {}, wrong_ = {};
};

}  // namespace plm_vins
