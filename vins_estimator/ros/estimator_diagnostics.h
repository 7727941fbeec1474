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

// Publishes the estimator's state on /diagnostics: waiting (for which topic), initializing (and
// why), tracking or lost; rates and delays of inputs and outputs; counts. Threads: the monitor
// imu() belongs to the thread that receives IMU samples, points() and lines() to the thread that
// calls Report(), and Update() to the thread that estimates.
class EstimatorDiagnostics {
 public:
  // Takes the resolved names of the subscribed topics.
  EstimatorDiagnostics(const ImuNoise& configured_noise, const std::string& imu_topic,
                       const std::string& points_topic, const std::string& lines_topic);

  StreamMonitor& imu() { return imu_; }
  StreamMonitor& points() { return points_; }
  StreamMonitor& lines() { return lines_; }

  // Count feature messages of unknown layout, and features that are impossible or have duplicate
  // ids.
  void CountMalformed(const std::string& what) { malformed_.Add(what); }
  void CountLeftOut(int64_t features) { left_out_.count += features; }
  DropCounts FeatureDrops() const { return {malformed_, left_out_}; }

  // To be called after each image, and after a reset with an output that only has a reason.
  // `frames` is the number of estimated images, `age` the age of the image when its pose was ready
  // [s].
  void Update(const EstimatorOutput& output, int64_t frames, double age);

  // To be called after each input, whether or not it completed an image.
  void UpdateCounts(const EstimationStage& stage, const DropCounts& drops);

  // `queued` is the number of inputs waiting for the estimator.
  void Report(size_t queued, diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  void ReportState(diagnostic_updater::DiagnosticStatusWrapper* status);
  std::string State() const;     // including the reason
  std::string WaitsFor() const;  // the silent topics; empty if none

  const std::string imu_topic_, points_topic_, lines_topic_;
  const ImuNoise configured_noise_;
  StreamMonitor imu_{"imu"};
  StreamMonitor points_{"points"};
  StreamMonitor lines_{"lines"};
  DropCount malformed_{"feature_messages_malformed", 0, ""};
  DropCount left_out_{"features_impossible", 0, ""};

  std::mutex mutex_;  // guards the following members
  StreamMonitor poses_{"odometry"};
  EstimatorStatus state_ = EstimatorStatus::kInitializing;
  std::string reason_;
  bool contradicted_ = false;
  bool on_imu_alone_ = false;
  ImuNoise imu_noise_ = configured_noise_;
  double imu_noise_scale_ = 1;
  int64_t bridged_losses_ = 0;
  int64_t imu_doubts_ = 0;
  std::string input_finding_, imu_contradiction_;
  std::string lens_warning_;
  std::string sensor_faults_;
  double pose_age_ = 0;       // [s]
  std::string last_restart_;  // reason for the last restart
  EstimatorCounts counts_;
  double estimator_ms_ = 0;
  int64_t frames_ = 0;
  ros::WallTime last_frame_ = ros::WallTime::now();
  int64_t resets_ = 0;
  size_t queued_frames_ = 0;
  bool lines_are_missing_ = false;
  int64_t frames_without_lines_ = 0;
  int64_t lines_without_points_ = 0;
  DropCounts drops_;  // counts of the thread that estimates
};

}  // namespace plm_vins
