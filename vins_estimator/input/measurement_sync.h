// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "common/imu/imu_sensor.h"
#include "common/measurements.h"
#include "common/streams/stamp_order.h"
#include "vins_estimator/input/imu_stream.h"
#include "vins_estimator/input/line_pairing.h"

namespace plm_vins {

// Counts of received and unusable images by cause, and of clock changes, since construction.
struct FrameStatistics {
  int64_t frames = 0;
  int64_t frames_out_of_order = 0;     // timestamp not increasing (repeated or backwards)
  int64_t frames_ahead_of_time = 0;    // jumped ahead and still unconfirmed
  int64_t frames_too_late = 0;         // waited for longer than allowed
  double longest_wait = 0;             // of these [s]
  int64_t frames_without_imu = 0;      // before the first IMU sample or, at the end, after the last
  int64_t frames_in_imu_gap = 0;       // in a gap of the IMU samples
  int64_t frames_too_close = 0;        // less than 1 ms of IMU time after the previous frame
  int64_t frames_dropped_full = 0;     // queue full: oldest dropped
  int64_t frames_with_few_points = 0;  // fewer than ten: dark, blank or blurred; still used
  // Resets: IMU or images went back in time permanently, or the IMU jumped ahead by a minute.
  int64_t jumps_back = 0;
  int64_t leaps_ahead = 0;
};

struct SyncStatistics : ImuStatistics, LinePairingStatistics, FrameStatistics {
  int64_t imu_dropped_full = 0;  // queue of samples full: oldest dropped
};

// Synchronizes the front end with the IMU: pairs point and line features by equal timestamps and
// cuts the IMU stream at the image times. Synchronous and single-threaded: add input in order of
// arrival, then call Pop() until it returns nullopt.
//
// A frame is ready when the IMU reaches t_image + td and the frame need not wait for its lines
// (LinePairing). An unusable frame is dropped and counted; the IMU samples before it then belong to
// the next frame, so that between the first and the last frame no sample is lost or used twice,
// even if td changes (ImuStream).
//
// If the IMU's clock was set (ImuDoor), or images go back in time permanently (a bag played
// again), everything except the statistics is reset and a new sequence starts.
class MeasurementSync {
 public:
  struct Options {
    double td = 0;  // t_imu = t_image + td [s]
    ImuSensor imu;
    bool expect_lines = false;    // wait (up to max_line_lag) for each image's line frame
    int max_line_lag = 3;         // longest wait for a line frame [images]
    double max_line_stall = 0.4;  // the same if the transport stalls [s]
    int line_patience = 10;       // consecutive frames without lines after which lines are missing
    // Once the IMU is further ahead of a frame than this [s], newer usable frames replace it: an
    // estimator that is too slow for the rate skips images.
    double max_wait = std::numeric_limits<double>::infinity();
    int max_frames = 200;  // longest queue of images and of line frames; beyond, drops the oldest
    int max_imu_samples = 50000;  // longest queue of samples; beyond, drops the oldest
  };

  explicit MeasurementSync(const Options& options);

  // Adds a sample as it arrives; returns what came through the door. If the clock was set,
  // everything before was dropped.
  AdmittedImu AddImu(const ImuSample& sample);
  // Returns whether the clock of the images was set back: then everything before was dropped.
  bool AddPoints(PointFrame frame);
  void AddLines(LineFrame frame);
  void SetTimeOffset(double td) { options_.td = td; }
  // Drops all queued data and timestamps, keeps the statistics.
  void Clear();

  // Returns the next frame in order of time; nullopt if none is ready. See FrameMeasurement for the
  // cutting of IMU samples.
  std::optional<FrameMeasurement> Pop();

  // To be called instead of Pop() after the end of the input: returns the remaining frames that the
  // IMU reaches, without waiting for lines. Later frames are dropped and counted.
  std::optional<FrameMeasurement> Flush();

  // Returns whether expected lines are missing permanently; frames are then output without them.
  bool lines_are_missing() const { return lines_.are_missing(); }

  // Returns whether lines do arrive, but their timestamps match no image.
  bool lines_are_of_other_images() const { return lines_.are_of_other_images(); }

  const ImuDoor& imu_door() const { return imu_.door(); }
  size_t queued_frames() const { return points_.size(); }
  SyncStatistics statistics() const {
    return {imu_door().statistics(), lines_.statistics(), statistics_, imu_.dropped_full()};
  }

 private:
  enum class FrameDefect { kTooClose, kWithoutImu, kInImuGap, kTooLate };

  // Drops images and lines.
  void ClearFrames();
  int64_t CutTime(size_t frame) const;  // IMU time of a queued frame; 0 is the oldest
  // Returns whether there is a queued frame and the IMU reaches the oldest one.
  bool OldestIsReached() const { return !points_.empty() && imu_.Reaches(CutTime(0)); }
  // Returns whether a queued frame need not wait for its lines; newer frames may still wait.
  bool LinesAreDecided(size_t frame) const;
  LinePairing::NewerImages NewerThan(size_t frame) const;
  void DropUnusableFrames();
  // Returns why the oldest queued frame is unusable; nullopt if usable. The IMU must reach it.
  std::optional<FrameDefect> FindDefect() const;
  void Count(FrameDefect defect);
  bool IsTooLate() const;
  double LeadOfImu() const;  // over the oldest frame [s]
  FrameMeasurement TakeFrame();

  Options options_;
  ImuStream imu_;
  LinePairing lines_;
  FrameStatistics statistics_;
  std::deque<PointFrame> points_;
  StampOrder points_order_;
};

}  // namespace plm_vins
