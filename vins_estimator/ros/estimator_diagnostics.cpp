// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/estimator_diagnostics.h"

#include "common/append.h"
#include "common/format.h"

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

void EstimatorDiagnostics::Update(const EstimatorReport& newest, int64_t frames, double age) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = newest;
  pose_age_ = age;
  bridged_losses_ += newest.bridged ? 1 : 0;
  imu_doubts_ += newest.imu_doubted ? 1 : 0;
  if (newest.restarted) last_restart_ = newest.reason;
  if (newest.has_pose) poses_.Add(newest.t_ns);
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
  const ImuNoise& imu_noise = newest_.has_pose ? newest_.imu_noise : configured_noise_;
  status->addf("accel_density", "%.2g", imu_noise.accel_density);
  status->addf("gyro_density", "%.2g", imu_noise.gyro_density);
  status->addf("imu_noise_scale", "%.1f", newest_.imu_noise_scale);
  status->add("imu_doubts", imu_doubts_);
  status->add("queued", queued);
  status->add("queued_frames", queued_frames_);
  status->add("estimator_ms", newest_.timings.total);
  status->add("points_observed", newest_.counts.points_observed);
  status->add("points_in_window", newest_.counts.points_in_window);
  status->add("matched_used", newest_.counts.matched.used);
  status->add("depths_used", newest_.counts.depth.used);
  status->add("lines_observed", newest_.counts.lines_observed);
  status->add("lines_in_window", newest_.counts.lines_in_window);
  status->add("frames_without_lines", frames_without_lines_);
  status->add("lines_without_points", lines_without_points_);
  DropCounts drops = FeatureDrops();
  Append(drops_, &drops);
  for (const DropCount& drop : drops) status->add(drop.cause, drop.count);
}

void EstimatorDiagnostics::ReportState(diagnostic_updater::DiagnosticStatusWrapper* status) {
  const std::string state = State();
  const bool tracking = state == ToString(EstimatorStatus::kTracking);
  const bool late = tracking && pose_age_ > kMaxPoseAge;
  const bool fine = tracking && !lines_are_missing_ && !late && !newest_.on_imu_alone &&
                    !newest_.contradicted && !input_finding_.is_present &&
                    imu_contradiction_.empty() && lens_warning_.empty() && sensor_faults_.empty();
  status->summary(
      fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
      JoinTexts(
          {state,
           lines_are_missing_ ? "points only: no lines arrive in time on " + lines_topic_ : "",
           late ? Format("late: poses are %.0f ms old", 1e3 * pose_age_) : "",
           newest_.on_imu_alone ? "blind: dead reckoning by the IMU" : "", input_finding_.text,
           imu_contradiction_, lens_warning_, sensor_faults_,
           newest_.contradicted ? "the camera contradicts the state" : ""},
          "; "));
}

std::string EstimatorDiagnostics::State() const {
  const std::string silent = WaitsFor();
  if (!silent.empty()) return "waiting: no messages on " + silent;
  const double unused = (ros::WallTime::now() - last_frame_).toSec();
  if (frames_ == 0) return "waiting: no usable image yet";
  if (unused > StreamMonitor::kSilence) return "waiting: no usable image any more";
  return ToString(newest_.status) + (newest_.reason.empty() ? "" : ": " + newest_.reason);
}

std::string EstimatorDiagnostics::WaitsFor() const {
  const bool no_imu = imu_.Silence() > StreamMonitor::kSilence;
  const bool no_points = points_.Silence() > StreamMonitor::kSilence;
  return (no_imu ? imu_topic_ : "") + (no_imu && no_points ? " and " : "") +
         (no_points ? points_topic_ : "");
}

}  // namespace plm_vins
