// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_diagnostics.h"

#include "common/ros/msg_conversion.h"

namespace plm_vins {

using diagnostic_msgs::DiagnosticStatus;

EstimatorDiagnostics::EstimatorDiagnostics(const Config& config, const std::string& points_topic,
                                           const std::string& lines_topic)
    : imu_topic_(config.sensor.imu_topic), points_topic_(points_topic), lines_topic_(lines_topic) {}

void EstimatorDiagnostics::Update(const EstimatorOutput& output, const EstimationStage& stage) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = output.status;
  reason_ = output.reason;
  if (output.restarted) last_restart_ = output.reason;
  if (output.has_pose) poses_.Add(ToRosTime(output.t_ns));
  counts_ = output.counts;
  estimator_ms_ = output.timings.total;
  if (stage.frames() > frames_) last_frame_ = ros::WallTime::now();
  frames_ = stage.frames();
  resets_ = stage.resets();
  queued_frames_ = stage.queued_frames();
  lines_are_missing_ = stage.lines_are_missing();
  sync_ = stage.statistics();
}

void EstimatorDiagnostics::Report(size_t queued,
                                  diagnostic_updater::DiagnosticStatusWrapper* status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ReportState(status);
  status->add("frames", frames_);
  status->add("resets", resets_);
  status->add("last_restart", last_restart_);
  for (StreamMonitor* stream : {&imu_, &points_, &lines_, &poses_}) stream->Report(status);
  status->add("queued", queued);
  status->add("queued_frames", queued_frames_);
  status->add("estimator_ms", estimator_ms_);
  status->add("points_observed", counts_.points_observed);
  status->add("points_in_window", counts_.points_in_window);
  status->add("lines_observed", counts_.lines_observed);
  status->add("lines_in_window", counts_.lines_in_window);
  status->add("frames_without_lines", sync_.frames_without_lines);
  status->add("lines_without_points", sync_.lines_without_points);
  status->add("feature_messages_malformed", malformed_messages_);
  for (const DropCount& drop : ToDropCounts(sync_)) status->add(drop.cause, drop.count);
}

void EstimatorDiagnostics::ReportState(diagnostic_updater::DiagnosticStatusWrapper* status) {
  std::string state = State();
  const bool tracking = state == ToString(EstimatorStatus::kTracking);
  if (lines_are_missing_) state += "; points alone: no lines come in time on " + lines_topic_;
  const bool fine = tracking && !lines_are_missing_;
  status->summary(fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN, state);
}

std::string EstimatorDiagnostics::State() const {
  const std::string silent = WaitsFor();
  if (!silent.empty()) return "waiting: nothing comes on " + silent;
  const double unused = (ros::WallTime::now() - last_frame_).toSec();
  if (frames_ == 0) return "waiting: no usable image yet";
  if (unused > StreamMonitor::kSilence) return "waiting: no usable image any more";
  return ToString(state_) + (reason_.empty() ? "" : ": " + reason_);
}

std::string EstimatorDiagnostics::WaitsFor() const {
  const bool no_imu = imu_.Silence() > StreamMonitor::kSilence;
  const bool no_points = points_.Silence() > StreamMonitor::kSilence;
  return (no_imu ? imu_topic_ : "") + (no_imu && no_points ? " and " : "") +
         (no_points ? points_topic_ : "");
}

}  // namespace plm_vins
