// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "common/imu/imu_range.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "common/streams/forward_jump.h"
#include "vins_estimator/imu/imu_gap.h"
#include "vins_estimator/input/imu_stream.h"
#include "vins_estimator/input/line_pairing.h"

namespace plm_vins {

// What images came in and could not be used, by cause, and how often a new recording began. All
// counts are since construction.
struct FrameStatistics {
  int64_t frames = 0;
  int64_t frames_out_of_order = 0;     // stamp not after the one before (repeated or backwards)
  int64_t frames_ahead_of_time = 0;    // leaped ahead, and alone there so far
  int64_t frames_too_late = 0;         // waited for longer than allowed
  int64_t frames_without_imu = 0;      // no IMU sample up to it, or at the end none after it
  int64_t frames_in_imu_gap = 0;       // the IMU says nothing at the time of the image
  int64_t frames_too_close = 0;        // under 1 ms of IMU time after the frame before
  int64_t frames_dropped_full = 0;     // queue full: oldest dropped
  int64_t frames_with_few_points = 0;  // under ten: dark, blank or blurred; the IMU carries on
  // All was forgotten: IMU or images went back in time for good, or the IMU ahead by a minute.
  int64_t jumps_back = 0;
  int64_t leaps_ahead = 0;
};

struct SyncStatistics : ImuStatistics, LinePairingStatistics, FrameStatistics {};

// Pairs point and line features by equal stamp and cuts the IMU stream at the image times.
// Synchronous and single-threaded: the caller feeds in order of arrival and pops until nothing is
// ready.
//
// A frame is ready when the IMU reaches t_image + td and its lines need not be waited for
// (LinePairing). A frame that cannot be used is dropped and counted; the IMU samples before it then
// lead to the next one: of the samples between the first and the last frame none is lost or used
// twice, also when td changes (ImuStream).
//
// Where the clock of the IMU was set (ImuStream), or images go back in time for good by more than
// ten (a bag played again), all is forgotten but the statistics, and a new recording begins.
class MeasurementSync {
 public:
  struct Options {
    double td = 0;  // t_imu = t_image + td [s]
    ImuRange imu_range;
    bool expect_lines = false;  // wait (a little) for the line frame of each image
    int max_line_lag = 3;       // images to wait for a line frame
    int line_patience = 10;     // frames in a row without lines until the lines count as missing
    double max_imu_gap = kMaxImuInterval;  // images in a longer one are dropped [s]
    // Frames of which the IMU is further ahead than this [s] are dropped as long as newer ones
    // could be used: what an estimator that cannot keep up leaves out.
    double max_wait = std::numeric_limits<double>::infinity();
    int max_frames = 200;         // queued images and line frames; beyond, the oldest is dropped
    int max_imu_samples = 50000;  // queued samples; beyond, the oldest is dropped
  };

  explicit MeasurementSync(const Options& options);

  void AddImu(const ImuSample& sample);
  void AddPoints(PointFrame frame);
  void AddLines(LineFrame frame);
  void SetTimeOffset(double td) { options_.td = td; }
  // Forgets all queued data and stamps, keeps the statistics.
  void Clear();

  // The next frame in order of time, or nothing yet. See FrameMeasurement for how the IMU is cut.
  std::optional<FrameMeasurement> Pop();

  // No more input: hands out what is left as far as the IMU reaches, without waiting for lines.
  // Frames beyond are dropped and counted.
  std::optional<FrameMeasurement> Flush();

  // Lines are expected but fail to come: frames are handed out without.
  bool lines_are_missing() const { return lines_.are_missing(); }

  // The lines that are missing do come, but of images of which no points come.
  bool lines_are_of_other_images() const { return lines_.are_of_other_images(); }

  size_t queued_frames() const { return points_.size(); }
  SyncStatistics statistics() const {
    return {imu_.statistics(), lines_.statistics(), statistics_};
  }

 private:
  enum class FrameDefect { kTooClose, kWithoutImu, kInImuGap, kTooLate };

  // Images and lines.
  void ClearFrames();
  int64_t CutTime(size_t frame) const;  // of a queued frame, the oldest being 0, in IMU time
  // There is a queued frame, and the IMU reaches the oldest one.
  bool OldestIsReached() const { return !points_.empty() && imu_.Reaches(CutTime(0)); }
  // Whether the lines of a queued frame need not be waited for; those of newer frames may.
  bool LinesAreDecided(size_t frame) const;
  void DropUnusableFrames();
  // Why the oldest queued frame cannot be used; nothing: it can. The IMU must reach it.
  std::optional<FrameDefect> FindDefect() const;
  void Count(FrameDefect defect);
  bool IsTooLate() const;
  FrameMeasurement TakeFrame();

  Options options_;
  ImuStream imu_;
  LinePairing lines_;
  FrameStatistics statistics_;
  std::deque<PointFrame> points_;
  std::optional<int64_t> last_points_ns_;  // stamp of the last frame accepted
  BackwardJumpDetector points_jump_;
  ForwardJumpDetector points_leap_;
};

}  // namespace plm_vins
