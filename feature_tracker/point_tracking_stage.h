// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "common/config.h"
#include "common/drop_counts.h"
#include "common/gyro_predictor.h"
#include "common/measurements.h"
#include "common/rate_limiter.h"
#include "feature_tracker/point_tracker.h"

namespace plm_vins {

// The features of one image, and what they cost.
struct TrackedFrame {
  PointFrame points;
  bool restart = false;  // stamps jumped back: a new recording begins here, what was before is void
  bool publish = true;   // false: thinned out by publish_rate
  double tracking_ms = 0;  // [ms]
};

// Images that could not be used, by cause. All counts are since construction.
struct PointTrackingCounts {
  int64_t images = 0;
  int64_t out_of_order = 0;  // stamp not after the one before (repeated or backwards)
  int64_t restarts = 0;      // stamps jumped back for good: a new recording
  int64_t wrong_format = 0;  // not grey or not of the calibrated size
  int64_t gaps = 0;          // more than a second since the image before; nothing is lost by it
  int64_t few_points = 0;    // under ten: dark, blank or blurred; the IMU alone carries on
  int64_t without_gyro = 0;  // predicted from the corners' own motion, as the gyro did not cover it
  std::string wrong_format_detail;
};

DropCounts ToDropCounts(const PointTrackingCounts& counts);

// The point front end as nodes and the offline runner use it: checks images, lets each wait (a
// little) until the gyro reaches it, tracks. Synchronous; feed in order of arrival and pop until
// nothing is ready, as with MeasurementSync.
class PointTrackingStage {
 public:
  explicit PointTrackingStage(const Config& config);

  void AddImu(const ImuSample& sample);

  // Stamps must increase; an image that goes back in time is dropped, unless more and more of them
  // follow: then it is a new recording.
  void AddImage(ImageSample image);

  // Features of the next image in order of time, or nothing yet. An image waits for the gyro until
  // two newer images have come.
  std::optional<TrackedFrame> Pop();

  // The same without waiting for the gyro.
  std::optional<TrackedFrame> Flush();

  bool waiting() const { return !images_.empty(); }

  const PointTracker& tracker() const { return tracker_; }
  const PointTrackingCounts& counts() const { return counts_; }

 private:
  struct WaitingImage {
    ImageSample image;
    bool restart = false;
  };

  // Not where the rotation between camera and gyro is yet to be calibrated, by the estimator.
  bool UsesGyro() const;
  bool IsNewRecording(int64_t refused_ns);
  TrackedFrame TrackFront();
  std::optional<Eigen::Quaterniond> PredictRotation(int64_t t_ns);

  Config config_;
  PointTracker tracker_;
  GyroPredictor gyro_;
  RateLimiter rate_limiter_;
  PointTrackingCounts counts_;
  std::deque<WaitingImage> images_;
  std::optional<int64_t> accepted_ns_;  // stamp of the last image taken in
  std::optional<int64_t> tracked_ns_;   // stamp of the last image tracked
  int64_t refused_ns_ = 0;              // stamp of the last image refused for its stamp
  int refused_in_a_row_ = 0;
  bool restart_pending_ = false;  // to be told with the next frame
};

}  // namespace plm_vins
