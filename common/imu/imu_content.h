// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/measurements.h"

namespace plm_vins {

// Detects samples that no working IMU sends as specific force [m/s^2] and angular rate [rad/s]:
// missing or alternating sensors, other units, removed gravity. Counts all samples since
// construction, before any is dropped or corrected.
class ImuContent {
 public:
  explicit ImuContent(double gravity_norm) : gravity_norm_(gravity_norm) {}

  void Add(const ImuSample& sample);

  // Returns what the samples of `topic` show, and what to do. Returns an empty string if they are
  // plausible or too few.
  std::string Finding(const std::string& topic) const;

 private:
  std::string MissingSensor(const std::string& topic) const;
  std::string WrongAccelerometer(const std::string& topic) const;
  std::string WrongGyro(const std::string& topic) const;

  const double gravity_norm_;  // [m/s^2]
  int64_t samples_ = 0;
  int64_t first_ns_ = 0, newest_ns_ = 0;
  int64_t with_gyro_ = 0, with_accel_ = 0, with_both_ = 0;  // not zero, and finite
  // Samples whose specific force has a norm near gravity in g, in thousandths of g, or in m/s^2; or
  // a norm far below gravity in m/s^2.
  int64_t near_one_g_ = 0, near_thousand_mg_ = 0, near_gravity_ = 0, far_below_gravity_ = 0;
  int64_t beyond_range_ = 0;  // samples with more specific force than any IMU can read
  int64_t fast_turns_ = 0;    // samples with an angular rate that blurs every image
};

}  // namespace plm_vins
