// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "common/imu/imu_noise.h"
#include "common/ros/stream_monitor.h"
#include "common/streams/drop_counts.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {

// What /diagnostics says of the estimator: waiting (for what), initializing (why not yet), tracking
// or lost; rates and delays of what comes in and goes out; counts. The IMU's monitor is for the
// thread that receives its samples, those of features for the thread that reports, Update for the
// one that estimates.
class EstimatorDiagnostics {
 public:
  // The topics as they are subscribed, in full.
  EstimatorDiagnostics(const ImuNoise& configured_noise, const std::string& imu_topic,
                       const std::string& points_topic, const std::string& lines_topic);

  StreamMonitor& imu() { return imu_; }
  StreamMonitor& points() { return points_; }
  StreamMonitor& lines() { return lines_; }

  // Messages of features that have another layout, and features that are impossible or whose ids
  // were there twice.
  void CountMalformed(const std::string& what) { malformed_.Add(what); }
  void CountLeftOut(int64_t features) { left_out_.count += features; }
  DropCounts FeatureDrops() const { return {malformed_, left_out_}; }

  // After each image, and with an output that only says why when all starts over. `frames`:
  // estimated so far; `age`: of the image when its pose came [s].
  void Update(const EstimatorOutput& output, int64_t frames, double age);

  // After each input, whether or not an image came of it.
  void UpdateCounts(const EstimationStage& stage, const DropCounts& drops);

  // `queued`: inputs that wait for the estimator.
  void Report(size_t queued, diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  void ReportState(diagnostic_updater::DiagnosticStatusWrapper* status);
  std::string State() const;     // and the reason for it
  std::string WaitsFor() const;  // the silent topics; empty: none

  const std::string imu_topic_, points_topic_, lines_topic_;
  const ImuNoise configured_noise_;
  StreamMonitor imu_{"imu"};
  StreamMonitor points_{"points"};
  StreamMonitor lines_{"lines"};
  DropCount malformed_{"feature_messages_malformed", 0, ""};
  DropCount left_out_{"features_impossible", 0, ""};

  std::mutex mutex_;  // guards what follows
  StreamMonitor poses_{"odometry"};
  EstimatorStatus state_ = EstimatorStatus::kInitializing;
  std::string reason_;
  bool contradicted_ = false;
  bool on_imu_alone_ = false;
  ImuNoise imu_noise_ = configured_noise_;
  double imu_noise_scale_ = 1;
  int64_t bridged_losses_ = 0;
  int64_t imu_doubts_ = 0;
  std::string imu_contradiction_;
  double pose_age_ = 0;       // [s]
  std::string last_restart_;  // why
  EstimatorCounts counts_;
  double estimator_ms_ = 0;
  int64_t frames_ = 0;
  ros::WallTime last_frame_ = ros::WallTime::now();
  int64_t resets_ = 0;
  size_t queued_frames_ = 0;
  bool lines_are_missing_ = false;
  int64_t frames_without_lines_ = 0;
  int64_t lines_without_points_ = 0;
  DropCounts drops_;  // of the thread that estimates
};

}  // namespace plm_vins
