// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_diagnostics.h"

#include <cmath>

#include "common/append.h"

namespace plm_vins {

using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr double kMaxPoseAge = 0.5;  // [s], above this a warning is reported

}  // namespace

EstimatorDiagnostics::EstimatorDiagnostics(const ImuNoise& configured_noise,
                                           const std::string& imu_topic,
                                           const std::string& points_topic,
                                           const std::string& lines_topic)
    : imu_topic_(imu_topic),
      points_topic_(points_topic),
      lines_topic_(lines_topic),
      configured_noise_(configured_noise) {}

void EstimatorDiagnostics::Update(const EstimatorOutput& output, int64_t frames, double age) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = output.status;
  reason_ = output.reason;
  pose_age_ = age;
  contradicted_ = output.contradicted;
  on_imu_alone_ = output.on_imu_alone;
  imu_noise_ = output.has_pose ? output.imu_noise : configured_noise_;
  imu_noise_scale_ = output.imu_noise_scale;
  bridged_losses_ += output.bridged ? 1 : 0;
  imu_doubts_ += output.imu_doubted ? 1 : 0;
  if (output.restarted) last_restart_ = output.reason;
  if (output.has_pose) poses_.Add(output.t_ns);
  counts_ = output.counts;
  estimator_ms_ = output.timings.total;
  if (frames > frames_) last_frame_ = ros::WallTime::now();
  frames_ = frames;
}

void EstimatorDiagnostics::UpdateCounts(const EstimationStage& stage, const DropCounts& drops) {
  const std::lock_guard<std::mutex> lock(mutex_);
  resets_ = stage.resets();
  input_finding_ = stage.InputFinding();
  imu_contradiction_ = stage.ImuContradiction();
  lens_warning_ = stage.LensWarning();
  sensor_faults_ = stage.SensorFaults();
  queued_frames_ = stage.queued_frames();
  lines_are_missing_ = stage.lines_are_missing();
  frames_without_lines_ = stage.statistics().frames_without_lines;
  lines_without_points_ = stage.statistics().lines_without_points;
  drops_ = drops;
}

void EstimatorDiagnostics::Report(size_t queued,
                                  diagnostic_updater::DiagnosticStatusWrapper* status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ReportState(status);
  status->add("frames", frames_);
  status->add("resets", resets_);
  status->add("last_restart", last_restart_);
  status->add("bridged_losses", bridged_losses_);
  for (StreamMonitor* stream : {&imu_, &points_, &lines_, &poses_}) stream->Report(status);
  status->addf("pose_age_ms", "%.0f", 1e3 * pose_age_);
  status->addf("accel_density", "%.2g", imu_noise_.accel_density);
  status->addf("gyro_density", "%.2g", imu_noise_.gyro_density);
  status->addf("imu_noise_scale", "%.1f", imu_noise_scale_);
  status->add("imu_doubts", imu_doubts_);
  status->add("queued", queued);
  status->add("queued_frames", queued_frames_);
  status->add("estimator_ms", estimator_ms_);
  status->add("points_observed", counts_.points_observed);
  status->add("points_in_window", counts_.points_in_window);
  status->add("matched_used", counts_.matched.used);
  status->add("depths_used", counts_.depth.used);
  status->add("lines_observed", counts_.lines_observed);
  status->add("lines_in_window", counts_.lines_in_window);
  status->add("frames_without_lines", frames_without_lines_);
  status->add("lines_without_points", lines_without_points_);
  DropCounts drops = FeatureDrops();
  Append(drops_, &drops);
  for (const DropCount& drop : drops) status->add(drop.cause, drop.count);
}

void EstimatorDiagnostics::ReportState(diagnostic_updater::DiagnosticStatusWrapper* status) {
  std::string state = State();
  const bool tracking = state == ToString(EstimatorStatus::kTracking);
  if (lines_are_missing_) state += "; points only: no lines arrive in time on " + lines_topic_;
  const bool late = tracking && pose_age_ > kMaxPoseAge;
  if (late)
    state += "; late: poses are " + std::to_string(std::lround(1e3 * pose_age_)) + " ms old";
  if (on_imu_alone_) state += "; blind: dead reckoning by the IMU";
  if (!input_finding_.empty()) state += "; " + input_finding_;
  if (!imu_contradiction_.empty()) state += "; " + imu_contradiction_;
  if (!lens_warning_.empty()) state += "; " + lens_warning_;
  if (!sensor_faults_.empty()) state += "; " + sensor_faults_;
  if (contradicted_) state += "; the camera contradicts the state";
  const bool fine = tracking && !lines_are_missing_ && !late && !on_imu_alone_ && !contradicted_ &&
                    input_finding_.empty() && imu_contradiction_.empty() && lens_warning_.empty() &&
                    sensor_faults_.empty();
  status->summary(fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN, state);
}

std::string EstimatorDiagnostics::State() const {
  const std::string silent = WaitsFor();
  if (!silent.empty()) return "waiting: no messages on " + silent;
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
