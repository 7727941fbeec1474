// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/imu/imu_door.h"
#include "common/measurements.h"

namespace plm_vins {

// Buffers the IMU samples that come through the door since the last cut, and cuts them into
// contiguous intervals. Each interval starts with the last sample of the previous one; between the
// first and the last cut, no sample is lost or used twice. If the clock was set, everything except
// the statistics is reset and a new sequence starts.
class ImuStream {
 public:
  // Beyond `max_samples`, the oldest samples are dropped.
  ImuStream(const ImuSensor& sensor, int max_samples) : door_(sensor), max_samples_(max_samples) {}

  // Adds a sample as it arrives. Returns what came through the door.
  AdmittedImu Add(const ImuSample& sample);
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

  const ImuDoor& door() const { return door_; }
  int64_t dropped_full() const { return dropped_full_; }  // the oldest, as the queue was full

 private:
  // Drops the queued samples.
  void ClearSamples();
  void Queue(const ImuSample& sample);
  // Returns the index of the first sample at or after the time.
  size_t FirstNotBefore(int64_t t_ns) const;

  ImuDoor door_;
  const int max_samples_;
  std::deque<ImuSample> samples_;  // starts with the boundary of the last cut, if any
  std::optional<int64_t> last_cut_ns_;
  int64_t dropped_full_ = 0;
};

}  // namespace plm_vins
