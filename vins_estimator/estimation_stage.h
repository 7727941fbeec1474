// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "common/streams/drop_counts.h"
#include "common/streams/stream_rhythm.h"
#include "vins_estimator/input/measurement_sync.h"
#include "vins_estimator/input/repeated_image_detector.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

class Estimator;

// What the estimator says about an image, and what else there is to publish.
struct EstimatedFrame {
  EstimatorOutput output;
  PointFrame points;           // that were estimated from
  LineFrame lines;             // the same; empty where there were none
  std::vector<ImuSample> imu;  // the same; to begin with, the last one of the frame before
  int64_t imu_ns = 0;          // on the IMU's clock, what the state stands for
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // of B, bias removed [rad/s]
  // Of each of its components, by the noise of one gyro sample [rad^2/s^2].
  double angular_velocity_variance = 0;
};

// The back end as the node and the offline runner use it: pairs features with IMU samples and hands
// them to the estimator. Synchronous; feed in order of arrival and pop until nothing is ready.
class EstimationStage {
 public:
  // `max_wait` [s]: images that wait for longer are left out (MeasurementSync::Options).
  explicit EstimationStage(const Config& config,
                           double max_wait = std::numeric_limits<double>::infinity());
  ~EstimationStage();

  void AddImu(const ImuSample& sample);
  void AddPoints(PointFrame frame);
  void AddLines(LineFrame frame) { sync_.AddLines(std::move(frame)); }

  // The estimate for the next image, or nothing yet.
  std::optional<EstimatedFrame> Pop() { return Process(sync_.Pop()); }

  // The same when no more input comes.
  std::optional<EstimatedFrame> Flush() { return Process(sync_.Flush()); }

  // Starts over: queued data and the state are forgotten, statistics go on. `reason` is that of the
  // next output, which announces the new world frame.
  void Reset(const std::string& reason);

  // Where the IMU comes too seldom to be integrated: that. Where the camera contradicts it
  // lastingly, or shows as much noise as is believed: by how much, and what in the stamps may be
  // the cause. Empty where they fit.
  std::string ImuContradiction() const;

  int64_t frames() const { return frames_; }  // estimated so far
  int64_t resets() const { return resets_; }  // times that a world frame was given up
  size_t queued_frames() const { return sync_.queued_frames(); }
  bool lines_are_missing() const { return sync_.lines_are_missing(); }
  bool lines_are_of_other_images() const { return sync_.lines_are_of_other_images(); }
  SyncStatistics statistics() const { return sync_.statistics(); }
  DropCounts Drops() const;  // what could not be used, by cause

 private:
  std::optional<EstimatedFrame> Process(std::optional<FrameMeasurement> measurement);
  void StartOver(const std::string& reason);
  // Starts over where a clock was set: what was estimated has nothing to do with what comes.
  void FollowClock();

  const double imu_rate_;  // as configured [Hz]
  const ImuNoise configured_noise_;
  const std::unique_ptr<Estimator> estimator_;  // so that users do not see the solver
  MeasurementSync sync_;
  RepeatedImageDetector repeated_images_;
  double least_speed_ = 0;  // of the newest image [m/s]
  StreamRhythm imu_rhythm_, image_rhythm_;
  ImuNoise imu_noise_;
  double imu_noise_scale_ = 1;
  std::optional<double> delay_;  // [s]
  int64_t frames_ = 0;
  int64_t frames_repeated_ = 0;  // what they show was not used
  int64_t resets_ = 0;
  int64_t jumps_back_ = 0, leaps_ahead_ = 0;   // followed so far
  bool anew_ = true;                           // no image since the start or since starting over
  std::optional<std::string> restart_reason_;  // for the next output
};

}  // namespace plm_vins
