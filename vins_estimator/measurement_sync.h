// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/measurements.h"

namespace plm_vins {

// Samples that could not be used, by cause. All counts are since construction.
struct SyncStatistics {
  int64_t imu_samples = 0;
  int64_t imu_not_finite = 0;        // NaN or infinity
  int64_t imu_out_of_order = 0;      // stamp not after the one before (repeated or backwards)
  int64_t imu_gaps = 0;              // intervals longer than the allowed gap, bridged
  int64_t frames = 0;
  int64_t frames_out_of_order = 0;
  int64_t frames_without_imu = 0;    // no IMU sample at or before the image
  int64_t lines_without_points = 0;  // line frame whose point frame never came
  int64_t frames_dropped_full = 0;   // queue full: oldest dropped
};

// Pairs point and line features by equal stamp and cuts the IMU stream at the image times.
// Synchronous, single-threaded; the caller feeds in order of arrival and pops until nothing is ready.
//
// A frame is ready when the IMU reaches t_image + td and, where lines are expected, when its line
// frame is there, a later line frame is there, or a newer point frame `max_line_lag` images ahead is there.
class MeasurementSync {
 public:
  struct Options {
    double td = 0;              // t_imu = t_image + td [s]
    bool expect_lines = false;  // wait (a little) for the line frame of each image
    int max_line_lag = 3;       // images to wait for a line frame
    double max_imu_gap = 0.05;  // a longer interval between samples is counted as a gap [s]
    int max_frames = 200;       // queued images; beyond, the oldest is dropped
  };

  explicit MeasurementSync(const Options& options);

  void AddImu(const ImuSample& sample);
  void AddPoints(PointFrame frame);
  void AddLines(LineFrame frame);
  void SetTimeOffset(double td) { options_.td = td; }
  void Clear();  // forgets all queued data, keeps the statistics

  // The next frame in order of time, or nothing yet. See FrameMeasurement for how the IMU is cut.
  std::optional<FrameMeasurement> Pop();

  // No more input: hands out what is left as far as the IMU reaches, without waiting for lines.
  std::optional<FrameMeasurement> Flush();

  size_t queued_frames() const { return points_.size(); }
  const SyncStatistics& statistics() const { return statistics_; }

 private:
  Options options_;
  SyncStatistics statistics_;
  std::deque<ImuSample> imu_;
  std::deque<PointFrame> points_;
  std::deque<LineFrame> lines_;
};

}  // namespace plm_vins
