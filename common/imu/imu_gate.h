// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_clipping.h"
#include "common/imu/imu_sensor.h"
#include "common/measurements.h"

namespace plm_vins {

// Replaces outlier readings of the IMU (a flipped bit on the bus, a shock) by linear interpolation
// between their neighbors. The doubt of the replacement (an additional standard deviation) equals
// the removed difference, since a shock may have moved the body after all.
//
// A reading is suspect if it exceeds the sensor's range, or differs from the last one by much more
// than previous readings did. A suspect waits for the next readings: if these return to the
// previous level within kMaxRun samples, it was an outlier; otherwise the motion did change, and it
// is accepted.
//
// A saturated reading is accepted as well, with a doubt of at least half the range, since the true
// value may be larger. The range is the configured one, or less if readings are clipped below it.
//
// Readings are judged as the sensor delivers them, and returned corrected (see ImuSensor), so
// everything that integrates IMU samples has to take them from a gate.
class ImuGate {
 public:
  static constexpr int kMaxRun = 5;  // consecutive suspects, 25 ms at 200 Hz

  explicit ImuGate(const ImuSensor& sensor);

  // Adds the next sample, which must be finite and later than the previous one. Returns the samples
  // that are now decided, in temporal order: none, or several that end with this one.
  std::vector<ImuSample> Add(const ImuSample& sample);

  // Discards the samples but keeps the counts.
  void Clear();

  int64_t replaced() const { return replaced_; }
  int64_t saturated() const { return saturated_; }  // readings at the end of the range
  // Returns at which readings the sensors end, below the configured range, and what to do; empty if
  // they do not.
  std::string Clipping() const;

 private:
  // Typical change between consecutive readings of one kind.
  struct Leaps {
    double always_allowed;
    double mean_square = 0;  // mean squared change between readings, clamped to the limit

    double Limit() const;
    void Learn(double leap);
  };

  bool IsSuspect(const ImuSample& sample) const;
  const ImuSample& Newest() const;  // accepted or not; at least one must have been accepted
  void LearnLeaps(const ImuSample& sample);
  // Returns the suspects, unchanged if `believed`, else replaced; `next` is the sample after them.
  std::vector<ImuSample> TakeSuspects(bool believed, const ImuSample& next);
  ImuSample Replace(const ImuSample& suspect, const ImuSample& next) const;

  ImuSensor sensor_;
  ImuClipping clipping_;
  ImuRange range_;                   // of the readings so far
  std::optional<ImuSample> last_;    // newest accepted sample
  std::vector<ImuSample> suspects_;  // all samples after `last_`
  Leaps gyro_leaps_, accel_leaps_;
  int64_t replaced_ = 0;
  int64_t saturated_ = 0;
};

}  // namespace plm_vins
