// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/imu/imu_range.h"
#include "common/measurements.h"

namespace plm_vins {

// Replaces single readings that do not fit those around them (a bit that flipped on the bus, a
// shock): by the straight line between their neighbours, with a doubt as large as what was taken
// away, as a shock may have moved the body all the same.
//
// A reading is suspect where it is beyond the sensor's range, or leaps from the last one by much
// more than the readings before it did. A suspect waits for the next readings: where they come back
// within kMaxRun it was an outlier; where they do not, the motion did change, and it is believed.
//
// A reading at the end of the range is believed, too, but the true one may be beyond: it comes with
// a doubt of half the range at least.
class ImuGate {
 public:
  static constexpr int kMaxRun = 5;  // suspects in a row, 25 ms at 200 Hz

  explicit ImuGate(const ImuRange& range);

  // Takes the next sample, which must be finite and later than the one before. Returns those that
  // are decided by it, in order of time: nothing, or some that end with this one.
  std::vector<ImuSample> Add(const ImuSample& sample);

  // Forgets the samples, not the counts.
  void Clear();

  int64_t replaced() const { return replaced_; }
  int64_t saturated() const { return saturated_; }  // at the end of the range

 private:
  // What is usual of one kind of reading.
  struct Leaps {
    double always_allowed;
    double mean_square = 0;  // of the difference to the reading before, cut off at the limit

    double Limit() const;
    void Learn(double leap);
  };

  bool IsSuspect(const ImuSample& sample) const;
  const ImuSample& Newest() const;  // believed or not; there must be one that was believed
  void LearnLeaps(const ImuSample& sample);
  // The suspects, as they are where they are believed, else replaced; `next` comes after them.
  std::vector<ImuSample> TakeSuspects(bool believed, const ImuSample& next);
  ImuSample Replace(const ImuSample& suspect, const ImuSample& next) const;

  ImuRange range_;
  std::optional<ImuSample> last_;    // the newest that was believed
  std::vector<ImuSample> suspects_;  // all that came after it
  Leaps gyro_leaps_, accel_leaps_;
  int64_t replaced_ = 0;
  int64_t saturated_ = 0;
};

}  // namespace plm_vins
