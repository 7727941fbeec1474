// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "common/imu/imu_gate.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "common/streams/forward_jump.h"
#include "vins_estimator/imu/imu_gap.h"
#include "vins_estimator/input/imu_memory.h"

namespace plm_vins {

// What came in and what could not be used, by cause. All counts are since construction.
struct SyncStatistics {
  int64_t imu_not_finite = 0;    // NaN or infinity
  int64_t imu_implausible = 0;   // beyond any sensor's range, zeros throughout, or not a stamp
  int64_t imu_replaced = 0;      // did not fit the samples around them (ImuGate)
  int64_t imu_saturated = 0;     // at the end of the sensor's range
  int64_t imu_out_of_order = 0;  // stamp not after the one before, or alone in the future
  int64_t imu_gaps = 0;          // intervals longer than the allowed gap, bridged
  int64_t imu_dropped_full = 0;  // no image came for long: oldest dropped
  int64_t frames = 0;
  int64_t frames_out_of_order = 0;     // stamp not after the one before (repeated or backwards)
  int64_t frames_ahead_of_time = 0;    // leaped ahead, and alone there so far
  int64_t frames_too_late = 0;         // waited for longer than allowed
  int64_t frames_without_imu = 0;      // no IMU sample up to it, or at the end none after it
  int64_t frames_in_imu_gap = 0;       // the IMU says nothing at the time of the image
  int64_t frames_too_close = 0;        // under 1 ms of IMU time after the frame before
  int64_t frames_dropped_full = 0;     // queue full: oldest dropped
  int64_t frames_with_few_points = 0;  // under ten: dark, blank or blurred; the IMU carries on
  int64_t frames_without_lines = 0;    // handed out without the line frame that was expected
  int64_t lines_out_of_order = 0;      // stamp not after the one before
  int64_t lines_late = 0;            // came after a frame of that time or later had been handed out
  int64_t lines_without_points = 0;  // line frame whose point frame never came
  // All was forgotten: IMU or images went back in time for good, or the IMU ahead by a minute.
  int64_t jumps_back = 0;
  int64_t leaps_ahead = 0;
};

// Pairs point and line features by equal stamp and cuts the IMU stream at the image times.
// Synchronous and single-threaded: the caller feeds in order of arrival and pops until nothing is
// ready.
//
// A frame is ready when the IMU reaches t_image + td and, where lines are expected, when its line
// frame is there, a later line frame is there, or a newer point frame `max_line_lag` images ahead
// is there. Where line frames fail to come at all, frames no longer wait for them, until one of
// an image that has points comes in time again. A frame that cannot be used is dropped and counted;
// the IMU samples before it then lead to the next one: of the samples between the first and the
// last frame none is lost or used twice, also when td changes.
//
// Where the IMU goes back in time for good by ten samples or more, or the images by more than ten
// (a bag played again, a clock set back), or the IMU leaps ahead by more than a minute (a clock set
// on), all is forgotten but the statistics, and a new recording begins. Samples of the IMU that are
// sent again within a second are none of that.
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
  bool lines_are_missing() const {
    return options_.expect_lines && frames_without_lines_in_a_row_ >= options_.line_patience;
  }

  // The lines that are missing do come, but of images of which no points come.
  bool lines_are_of_other_images() const {
    return lines_are_missing() && 2 * unpaired_lines_in_a_row_ >= options_.line_patience;
  }

  size_t queued_frames() const { return points_.size(); }
  const SyncStatistics& statistics() const { return statistics_; }

 private:
  enum class FrameDefect { kTooClose, kWithoutImu, kInImuGap, kTooLate };

  // Decides on the sample after a gap, now that the stamp of the next one is known.
  void JudgeImuAfterGap(int64_t next_ns);
  void TakeImu(const ImuSample& sample);
  void QueueImu(const ImuSample& sample);
  int64_t CutTime() const;  // of the oldest queued frame, in IMU time
  // Index of the first IMU sample at or after the time.
  size_t FirstImuNotBefore(int64_t t_ns) const;
  // Whether the lines of a queued frame need not be waited for; those of newer frames may.
  bool LinesAreDecided(size_t frame) const;
  // While frames do not wait for lines: the one of that image would still wait if they did.
  bool IsInTime(int64_t lines_ns) const;
  void DropUnusableFrames();
  // Why the oldest queued frame cannot be used; nothing: it can. The IMU must reach it.
  std::optional<FrameDefect> FindDefect() const;
  void Count(FrameDefect defect);
  bool IsTooLate() const;
  FrameMeasurement TakeFrame();
  std::vector<ImuSample> CutImu(int64_t cut_ns);
  std::optional<LineFrame> TakeLines(int64_t t_ns);

  Options options_;
  SyncStatistics statistics_;
  std::deque<ImuSample> imu_;  // the front is the boundary of the last cut, once there was one
  ImuMemory imu_memory_;       // of those that went to the gate
  ImuGate imu_gate_;
  std::optional<int64_t> last_imu_ns_;  // of the newest sample that went to the gate
  // After a gap a sample waits for the next one: a single wrong stamp must not void what follows.
  std::optional<ImuSample> imu_after_gap_;
  std::deque<PointFrame> points_;
  std::deque<LineFrame> lines_;
  std::optional<int64_t> last_cut_ns_;     // IMU time
  std::optional<int64_t> last_points_ns_;  // stamps of the last frames accepted and handed out
  std::optional<int64_t> last_lines_ns_;
  std::deque<int64_t> last_popped_ns_;  // as many as a line frame may lag behind, oldest first
  int frames_without_lines_in_a_row_ = 0;
  int unpaired_lines_in_a_row_ = 0;
  BackwardJumpDetector imu_jump_;
  BackwardJumpDetector points_jump_;
  ForwardJumpDetector points_leap_;
};

}  // namespace plm_vins
