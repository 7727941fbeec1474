// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/imu/imu_gate.h"
#include "common/imu/imu_sensor.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "vins_estimator/input/imu_memory.h"

namespace plm_vins {

// Counts of unusable IMU samples by cause, since construction.
struct ImuStatistics {
  int64_t imu_not_finite = 0;    // NaN or infinity
  int64_t imu_implausible = 0;   // outside any sensor's range, all zero, or invalid timestamp
  int64_t imu_replaced = 0;      // outliers among their neighbors (ImuGate)
  int64_t imu_saturated = 0;     // at the limit of the sensor's range
  int64_t imu_out_of_order = 0;  // timestamp not increasing, or far ahead and unconfirmed
  int64_t imu_gaps = 0;          // intervals longer than the allowed gap, integrated across
  std::string first_imu_gap;     // its length and time
  int64_t imu_dropped_full = 0;  // queue full: oldest dropped
};

// Buffers IMU samples since the last cut and cuts them into contiguous intervals. Unusable samples
// are dropped and counted. Each interval starts with the last sample of the previous one; between
// the first and the last cut, no sample is lost or used twice.
//
// If timestamps go back permanently (kImuJumps: a bag played again, or a clock set
// back) or jump ahead by more than a minute (a clock set ahead), everything except the statistics
// is reset and a new sequence starts. Samples that are sent twice within a second have no such
// effect.
class ImuStream {
 public:
  // Effect of a sample on the clock.
  enum class Clock { kRunsOn, kSetBack, kSetOn };

  // `max_gap` is the longest interval between samples that is not a gap [s]. Beyond `max_samples`,
  // the oldest samples are dropped.
  ImuStream(const ImuSensor& sensor, double max_gap, int max_samples);

  // Adds a sample; unless kRunsOn is returned, the clock was set, and all earlier samples were
  // dropped.
  [[nodiscard]] Clock Add(const ImuSample& sample);
  // Drops samples and timestamps, keeps the statistics.
  void Clear();

  // Returns whether there is a sample at that time or later.
  bool Reaches(int64_t t_ns) const { return !samples_.empty() && samples_.back().t_ns >= t_ns; }

  // Times of the oldest and newest sample; there must be samples.
  int64_t first_ns() const { return samples_.front().t_ns; }
  int64_t newest_ns() const { return samples_.back().t_ns; }

  // Returns whether the time is inside a gap. There must be a sample at or before it and Reaches()
  // must hold.
  bool IsInGap(int64_t t_ns) const;

  // Returns the samples from the last cut, or from the start, up to the given time, with a sample
  // interpolated at that time if necessary. Same preconditions as IsInGap().
  std::vector<ImuSample> Cut(int64_t t_ns);
  std::optional<int64_t> last_cut_ns() const { return last_cut_ns_; }

  const ImuStatistics& statistics() const { return statistics_; }

 private:
  // Counts invalid samples.
  bool IsReading(const ImuSample& sample);
  bool LeavesGap(int64_t t_ns) const { return last_ns_ && IsGap(*last_ns_, t_ns); }
  bool IsGap(int64_t begin_ns, int64_t end_ns) const;
  // Decides on the sample after a gap, now that the next timestamp is known. Returns true if the
  // clock was set ahead.
  bool JudgeSampleAfterGap(int64_t next_ns);
  void Take(const ImuSample& sample);
  void Queue(const ImuSample& sample);
  // Returns the index of the first sample at or after the time.
  size_t FirstNotBefore(int64_t t_ns) const;

  const double max_gap_;  // [s]
  const int max_samples_;
  ImuStatistics statistics_;
  std::deque<ImuSample> samples_;  // starts with the boundary of the last cut, if any
  std::optional<int64_t> last_cut_ns_;
  ImuGate gate_;                    // samples that it accepted are in the queue
  ImuMemory memory_;                // samples passed to the gate
  std::optional<int64_t> last_ns_;  // newest sample passed to the gate
  // A sample after a gap waits for the next one, so that one wrong timestamp does not invalidate
  // the following samples.
  std::optional<ImuSample> after_gap_;
  BackwardJumpDetector jump_;
};

}  // namespace plm_vins
