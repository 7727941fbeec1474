// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_bursts.h"
#include "common/imu/imu_gate.h"
#include "common/measurements.h"
#include "common/streams/stamp_order.h"

namespace plm_vins {

// Counts of unusable IMU samples by cause, since construction.
struct ImuStatistics {
  int64_t imu_not_finite = 0;    // NaN or infinity
  int64_t imu_implausible = 0;   // outside any sensor's range, all zero, or invalid timestamp
  int64_t imu_replaced = 0;      // outliers among their neighbors (ImuGate)
  int64_t imu_saturated = 0;     // at the limit of the sensor's range
  std::string clipping;          // that limit and what to do, if it is below the configured range
  int64_t imu_stuck = 0;         // repeated by a sensor in motion for longer than kMaxImuInterval
  std::string first_imu_stuck;   // its time and what to do
  int64_t imu_out_of_order = 0;  // timestamp not increasing, or far ahead and unconfirmed
  int64_t imu_gaps = 0;          // intervals longer than kMaxImuInterval, integrated across
  std::string first_imu_gap;     // its length and time
};

// Whether a clock ran on, or was set back or forward.
enum class ClockChange { kNone, kBack, kForward };

// Samples that the door has let in.
struct AdmittedImu {
  ClockChange clock = ClockChange::kNone;  // otherwise the samples do not follow earlier ones
  std::vector<ImuSample> samples;          // in order of time; often one, maybe none
};

// The door through which all users get their IMU samples: it spreads bursts (ImuBursts), drops
// unusable samples, notices that the clock was set, replaces outliers and corrects the readings
// (ImuGate). The samples that come out increase in time.
//
// A reading that a sensor in motion, whose readings have changed so far, repeats for longer than
// kMaxImuInterval is no reading: its driver has lost the sensor. The repetitions leave a gap.
//
// The clock was set if timestamps go back permanently (a bag played again), or jump ahead by more
// than a minute. Samples that are sent twice within a second do not count as such. A sample after a
// gap waits for the next one, so that one wrong timestamp does not invalidate the following
// samples.
class ImuDoor {
 public:
  // Patience of users that wait for the trackers to decide first [samples].
  static constexpr int kPatience = 1000;

  // If timestamps go back, the clock was set after more than `patience` samples.
  explicit ImuDoor(const ImuSensor& sensor, int patience = kPatience)
      : gate_(sensor), jump_(patience) {}

  AdmittedImu Add(const ImuSample& sample);

  // Accepts any next sample; keeps the statistics.
  void Clear();

  const ImuBursts& bursts() const { return bursts_; }
  ImuStatistics statistics() const;

 private:
  bool IsReading(const ImuSample& sample);  // counts if it is not
  bool IsStuck(const ImuSample& sample);    // counts if it is
  bool IsRepeated(const ImuSample& sample) const;
  // Decides on the sample after a gap, now that the next timestamp is known.
  void DecideAfterGap(int64_t next_ns, AdmittedImu* admitted);
  void Take(const ImuSample& sample, AdmittedImu* admitted);

  ImuBursts bursts_;
  ImuGate gate_;
  std::deque<ImuSample> recent_;  // passed to the gate in the last second
  BackwardJumpDetector jump_;
  std::optional<ImuSample> first_alike_;  // with the same readings as the newest sample
  int64_t changes_ = 0;                   // of readings
  std::optional<ImuSample> after_gap_;
  ImuStatistics statistics_;  // except those of the gate
};

}  // namespace plm_vins
