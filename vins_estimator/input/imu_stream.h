// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/imu/imu_gate.h"
#include "common/imu/imu_range.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "vins_estimator/input/imu_memory.h"

namespace plm_vins {

// What of the IMU could not be used, by cause. All counts are since construction.
struct ImuStatistics {
  int64_t imu_not_finite = 0;    // NaN or infinity
  int64_t imu_implausible = 0;   // beyond any sensor's range, zeros throughout, or not a stamp
  int64_t imu_replaced = 0;      // did not fit the samples around them (ImuGate)
  int64_t imu_saturated = 0;     // at the end of the sensor's range
  int64_t imu_out_of_order = 0;  // stamp not after the one before, or alone in the future
  int64_t imu_gaps = 0;          // intervals longer than the allowed gap, bridged
  int64_t imu_dropped_full = 0;  // no cut for long: oldest dropped
};

// The samples of the IMU, from the last cut on. Those that say nothing are dropped and counted, the
// others are cut into intervals that join: each opens with the sample that closed the one before,
// and between the first and the last cut no sample is lost or used twice.
//
// Where stamps go back for good by ten samples or more (a bag played again, a clock set back), or
// leap ahead by more than a minute (a clock set on), all is forgotten but the statistics, and a new
// recording begins. Samples that are sent again within a second are none of that.
class ImuStream {
 public:
  // What came of the clock with a sample.
  enum class Clock { kRunsOn, kSetBack, kSetOn };

  // Samples further apart than `max_gap` [s] leave a gap. Beyond `max_samples` the oldest are
  // dropped.
  ImuStream(const ImuRange& range, double max_gap, int max_samples);

  // The clock was set: what came before this sample is forgotten.
  [[nodiscard]] Clock Add(const ImuSample& sample);
  // Forgets samples and stamps, keeps the statistics.
  void Clear();

  // There are samples at that time or later.
  bool Reaches(int64_t t_ns) const { return !samples_.empty() && samples_.back().t_ns >= t_ns; }

  // The others ask for samples.
  int64_t first_ns() const { return samples_.front().t_ns; }
  int64_t newest_ns() const { return samples_.back().t_ns; }

  // The time is between two samples that leave a gap. There must be some before or at it, and the
  // stream must reach it.
  bool IsInGap(int64_t t_ns) const;

  // The samples since the last cut, or all so far, up to that time; there the last one is
  // interpolated where none is. The same must hold.
  std::vector<ImuSample> Cut(int64_t t_ns);
  std::optional<int64_t> last_cut_ns() const { return last_cut_ns_; }

  const ImuStatistics& statistics() const { return statistics_; }

 private:
  // Counts those that no sensor has read.
  bool IsReading(const ImuSample& sample);
  bool LeavesGap(int64_t t_ns) const { return last_ns_ && IsGap(*last_ns_, t_ns); }
  bool IsGap(int64_t begin_ns, int64_t end_ns) const;
  // Decides on the sample after a gap, now that the stamp of the next one is known. True: with it
  // the clock was set on.
  bool JudgeSampleAfterGap(int64_t next_ns);
  void Take(const ImuSample& sample);
  void Queue(const ImuSample& sample);
  // Index of the first sample at or after the time.
  size_t FirstNotBefore(int64_t t_ns) const;

  const double max_gap_;  // [s]
  const int max_samples_;
  ImuStatistics statistics_;
  std::deque<ImuSample> samples_;  // the front is the boundary of the last cut, once there was one
  std::optional<int64_t> last_cut_ns_;
  ImuGate gate_;                    // what it has decided on is in the queue
  ImuMemory memory_;                // of those that went to the gate
  std::optional<int64_t> last_ns_;  // of the newest sample that went to the gate
  // After a gap a sample waits for the next one: a single wrong stamp must not void what follows.
  std::optional<ImuSample> after_gap_;
  BackwardJumpDetector jump_;
};

}  // namespace plm_vins
