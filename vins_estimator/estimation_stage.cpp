// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimation_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/append.h"
#include "common/format.h"
#include "vins_estimator/estimator.h"
#include "vins_estimator/imu/imu_gap.h"
#include "vins_estimator/initialization/rotation_check.h"
#include "vins_estimator/monitoring/contradiction_report.h"
#include "vins_estimator/monitoring/sensor_report.h"
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

namespace plm_vins {
namespace {

// Returns a lower bound on the speed, three standard deviations below the estimate [m/s].
double LeastSpeed(const EstimatorOutput& output) {
  if (!output.has_pose || !output.uncertainty) return 0;
  const double deviation = std::sqrt(output.uncertainty->velocity.diagonal().maxCoeff());
  return std::max(0.0, output.state.velocity().norm() - 3 * deviation);
}

// Ratio of the estimated noise to that of the samples: at most 1.1 in flights with the right
// calibration, 3 to 6 with td off by 30 ms or focal lengths off by 15 %.
constexpr double kContradictingNoise = 2.5;

// Time in doubt or without a pose after which the cause is searched for, and its limit [s].
constexpr double kLongDoubt = 2, kMaxDoubt = 6;

// Returns whether the estimated noise is at its upper limit.
bool IsAtLimit(double density, double configured_density) {
  return density > 0.999 * kMostNoise * configured_density;
}

MeasurementSync::Options MakeSyncOptions(const Config& config, double max_wait) {
  MeasurementSync::Options options;
  options.td = config.sensor.td;
  options.imu = config.sensor.imu;
  options.expect_lines = config.use_lines;
  options.max_wait = max_wait;
  return options;
}

}  // namespace

EstimationStage::EstimationStage(const Config& config, double max_wait)
    : imu_rate_(config.sensor.imu_rate),
      configured_noise_(config.sensor.imu_noise),
      estimator_(std::make_unique<Estimator>(config)),
      door_(config.sensor),
      input_check_(config.sensor),
      rotation_check_(std::make_unique<RotationCheck>(config.sensor, config.estimator.point_noise)),
      sync_(MakeSyncOptions(config, max_wait)),
      repeated_images_(config.sensor.imu_noise),
      imu_noise_(config.sensor.imu_noise) {}

EstimationStage::~EstimationStage() = default;

void EstimationStage::AddImu(const ImuSample& sample) {
  const ImuSample spread = input_check_.AddImu(sample);
  imu_noise_meter_.Add(spread);
  imu_rhythm_.Add(spread.t_ns);
  sync_.AddImu(spread);
}

void EstimationStage::AddPoints(PointFrame frame) {
  door_.Admit(&frame);
  input_check_.AddImage(frame.t_ns);
  image_rhythm_.Add(frame.t_ns);
  sync_.AddPoints(std::move(frame));
}

void EstimationStage::AddLines(LineFrame frame) {
  door_.Admit(&frame);
  sync_.AddLines(std::move(frame));
}

DropCounts EstimationStage::Drops() const {
  const SyncStatistics statistics = sync_.statistics();
  DropCounts drops = {
      {"imu_not_finite", statistics.imu_not_finite, ""},
      {"imu_implausible", statistics.imu_implausible, ""},
      {"imu_replaced", statistics.imu_replaced, ""},
      {"imu_saturated", statistics.imu_saturated, ""},
      {"imu_out_of_order", statistics.imu_out_of_order, ""},
      {"imu_gaps", statistics.imu_gaps, statistics.first_imu_gap},
      {"imu_dropped_full", statistics.imu_dropped_full, ""},
      {"frames_out_of_order", statistics.frames_out_of_order, ""},
      {"frames_ahead_of_time", statistics.frames_ahead_of_time, ""},
      {"frames_too_late", statistics.frames_too_late,
       Format("at most %.2f s older than the newest IMU sample", statistics.longest_wait)},
      {"frames_without_imu", statistics.frames_without_imu, ""},
      {"frames_in_imu_gap", statistics.frames_in_imu_gap, ""},
      {"frames_too_close", statistics.frames_too_close, ""},
      {"frames_dropped_full", statistics.frames_dropped_full, ""},
      {"frames_with_few_points", statistics.frames_with_few_points, ""},
      {"frames_repeated", frames_repeated_, ""},
      {"lines_out_of_order", statistics.lines_out_of_order, ""},
      {"lines_late", statistics.lines_late, ""},
      {"jumps_back", statistics.jumps_back, ""},
      {"leaps_ahead", statistics.leaps_ahead, ""}};
  Append(door_.Drops(), &drops);
  return drops;
}

std::string EstimationStage::ImuContradiction() const {
  const double imu_interval = imu_rhythm_.Interval();
  if (imu_interval > kMaxImuInterval) {
    return Format("the IMU rate is %.1f Hz; at least %.0f Hz is needed: raise the driver's rate",
                  1 / imu_interval, 1 / kMaxImuInterval);
  }
  ContradictionEvidence evidence;
  evidence.noise_factor = std::max({std::sqrt(imu_noise_scale_),
                                    imu_noise_.accel_density / NoiseOfSamples().accel_density,
                                    imu_noise_.gyro_density / NoiseOfSamples().gyro_density});
  const bool at_limit = IsAtLimit(imu_noise_.accel_density, configured_noise_.accel_density) ||
                        IsAtLimit(imu_noise_.gyro_density, configured_noise_.gyro_density);
  if (imu_noise_scale_ <= 1 && evidence.noise_factor < kContradictingNoise && !delay_ &&
      !at_limit) {
    return "";
  }
  evidence.delay = delay_;
  evidence.imu_jitter = imu_rhythm_.Jitter();
  evidence.image_jitter = image_rhythm_.Jitter();
  evidence.imu_rate = imu_interval > 0 ? 1 / imu_interval : imu_rate_;
  evidence.configured_imu_rate = imu_rate_;
  evidence.accel_noise_factor = imu_noise_meter_.accel_density() / configured_noise_.accel_density;
  evidence.gyro_noise_factor = imu_noise_meter_.gyro_density() / configured_noise_.gyro_density;
  using Rotations = ContradictionEvidence::Rotations;
  if (rotation_check_->agrees()) evidence.rotations = Rotations::kAgree;
  if (!rotation_check_->finding().empty()) evidence.rotations = Rotations::kExplained;
  return DescribeContradiction(evidence);
}

ImuNoise EstimationStage::NoiseOfSamples() const {
  ImuNoise noise = configured_noise_;
  noise.accel_density = std::max(noise.accel_density, imu_noise_meter_.accel_density());
  noise.gyro_density = std::max(noise.gyro_density, imu_noise_meter_.gyro_density());
  return noise;
}

std::string EstimationStage::InputFinding() const {
  std::string finding = input_check_.Finding();
  if (!finding.empty()) return finding;
  if (!rotation_check_->finding().empty()) return rotation_check_->finding();
  const double unfelt_motion = estimator_->unfelt_motion();
  if (unfelt_motion < kLongDoubt) return "";
  return Format(
      "the camera sees motion that the IMU does not feel, for %.1f s: something that moves fills "
      "the view (a train, the deck of a ship), or the IMU does not belong to this camera; "
      "meanwhile the images move no estimate and start none",
      unfelt_motion);
}

// A doubt decays half as fast as it grows.
void EstimationStage::CheckRotations(const FrameMeasurement& measurement,
                                     const EstimatorOutput& output) {
  const double interval = ToSeconds(measurement.imu.back().t_ns - measurement.imu.front().t_ns);
  const bool in_doubt = !output.has_pose || output.contradicted || output.imu_noise_scale > 1;
  doubt_ = std::clamp(doubt_ + (in_doubt ? interval : -0.5 * interval), 0.0, kMaxDoubt);
  rotation_check_->Add(measurement, doubt_ > kLongDoubt);
}

const std::string& EstimationStage::LensWarning() const { return estimator_->lens().warning(); }

std::vector<ResidualRing> EstimationStage::ResidualRings() const {
  return estimator_->lens().Rings();
}

std::string EstimationStage::SensorFaults() const { return DescribeFaults(cameras_, depth_); }

void EstimationStage::Reset(const std::string& reason) {
  sync_.Clear();
  StartOver(reason);
}

// If there was no output since the last start, there is no world frame to end and to announce.
void EstimationStage::StartOver(const std::string& reason) {
  estimator_->Reset();
  repeated_images_.Reset();
  least_speed_ = 0;
  imu_noise_ = configured_noise_;
  imu_noise_scale_ = 1;
  delay_.reset();
  cameras_.clear();
  depth_ = {};
  sync_.SetTimeOffset(estimator_->time_offset());
  if (reinitializing_) return;
  ++resets_;
  restart_reason_ = reason;
  reinitializing_ = true;
}

void EstimationStage::FollowClock() {
  const SyncStatistics now = sync_.statistics();
  if (now.leaps_ahead > leaps_ahead_)
    StartOver("no IMU for more than a minute, or its clock jumped forward");
  if (now.jumps_back > jumps_back_) StartOver("timestamps jumped back");
  leaps_ahead_ = now.leaps_ahead;
  jumps_back_ = now.jumps_back;
}

std::optional<EstimatedFrame> EstimationStage::Process(
    std::optional<FrameMeasurement> measurement) {
  if (!measurement) return std::nullopt;
  FollowClock();
  if (repeated_images_.Add(*measurement, least_speed_)) {
    ++frames_repeated_;
    measurement->points.points.clear();
    measurement->lines.reset();
  }
  EstimatedFrame frame;
  frame.output = estimator_->Process(*measurement);
  frame.points = measurement->points;
  if (measurement->lines) frame.lines = *measurement->lines;
  ++frames_;
  if (frame.output.has_pose) imu_noise_ = frame.output.imu_noise;
  least_speed_ = LeastSpeed(frame.output);
  imu_noise_scale_ = frame.output.imu_noise_scale;
  delay_ = frame.output.delay;
  cameras_ = frame.output.cameras;
  depth_ = frame.output.depth;
  if (frame.output.restarted) ++resets_;
  reinitializing_ = false;
  if (restart_reason_) {
    frame.output.restarted = true;
    frame.output.reason = *std::exchange(restart_reason_, std::nullopt);
  }
  CheckRotations(*measurement, frame.output);
  sync_.SetTimeOffset(estimator_->time_offset());
  frame.imu = measurement->imu;
  const std::vector<ImuSample>& imu = frame.imu;
  frame.imu_ns = imu.back().t_ns;
  if (imu.size() > 1) {
    const double interval =
        ToSeconds(imu.back().t_ns - imu.front().t_ns) / static_cast<double>(imu.size() - 1);
    frame.angular_velocity = imu.back().gyro - frame.output.state.gyro_bias();
    frame.angular_velocity_variance = std::pow(frame.output.imu_noise.gyro_density, 2) / interval;
  }
  return frame;
}

}  // namespace plm_vins
