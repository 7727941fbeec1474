// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimation_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/append.h"
#include "common/format.h"
#include "common/imu/imu_samples.h"
#include "common/recent_time.h"
#include "common/streams/stream_rhythm.h"
#include "vins_estimator/estimator.h"
#include "vins_estimator/imu/imu_noise_meter.h"
#include "vins_estimator/input/repeated_image_detector.h"
#include "vins_estimator/lengths/stated_lengths.h"
#include "vins_estimator/monitoring/fault_report.h"
#include "vins_estimator/rotation_calibration/rotation_check.h"
#include "vins_estimator/state/derived_covariance.h"
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

namespace plm_vins {
namespace {

constexpr char kJumpedBack[] = "timestamps jumped back";
constexpr char kUnfeltBeforeStart[] =
    "constant speed: scale not observable yet, as the camera sees motion that the IMU does not "
    "feel: accelerate; or something that moves fills the view (a train, the deck of a ship), or "
    "the IMU does not belong to this camera; meanwhile the images start no estimate";
constexpr char kUnfeltInFlight[] =
    "the camera sees motion that the IMU does not feel: something that moves fills the view (a "
    "train, the deck of a ship), or the IMU does not belong to this camera; meanwhile the images "
    "move no estimate";

constexpr char kUnseen[] =
    "the camera sees no motion that the IMU feels: a lift or a vehicle, in which the view moves "
    "along, or the IMU is not fixed to the camera; meanwhile the pose is relative to the view";

// Standard deviations that stand for findings without any: what the data state themselves, and what
// other causes may show as well.
constexpr double kFact = 1000, kUnfeltMotion = 8;

// Returns a lower bound on the speed, three standard deviations below the estimate [m/s].
double LeastSpeed(const EstimatorOutput& output) {
  if (!output.has_pose || !output.uncertainty) return 0;
  const double deviation = std::sqrt(output.uncertainty->velocity.diagonal().maxCoeff());
  return std::max(0.0, output.state.velocity().norm() - 3 * deviation);
}

// Ratio of the estimated noise to that of the samples: at most 1.1 in flights with the right
// calibration, 3 to 6 with td off by 30 ms or focal lengths off by 15 %.
constexpr double kContradictingNoise = 2.5;

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

struct EstimationStage::PerWorld {
  explicit PerWorld(const Config& config) : repeated_images(config.sensor.imu_noise) {
    for (int i = 0; i < static_cast<int>(config.sensor.cameras.size()); ++i) {
      rotation_checks.emplace_back(config.sensor, i, config.estimator.point_noise);
    }
  }

  std::vector<RotationCheck> rotation_checks;  // by camera
  RecentTime doubt;                            // with doubts or without a pose
  FindingMemory input_faults;
  RepeatedImageDetector repeated_images;
  double least_speed = 0;  // lower bound at the newest image [m/s]
  ImuNoiseMeter imu_noise_meter;
  StreamRhythm imu_rhythm, image_rhythm;
  EstimatorReport newest;
};

EstimationStage::EstimationStage(const Config& config, double max_wait)
    : config_(config),
      estimator_(std::make_unique<Estimator>(config)),
      lengths_(std::make_unique<StatedLengths>(config)),
      door_(config.sensor),
      input_check_(config.sensor),
      sync_(MakeSyncOptions(config, max_wait)),
      world_(std::make_unique<PerWorld>(config)) {}

EstimationStage::~EstimationStage() = default;

// If a clock was set, the estimate is unrelated to the new timestamps.
void EstimationStage::AddImu(const ImuSample& sample) {
  input_check_.AddImu(sample);
  const AdmittedImu admitted = sync_.AddImu(sample);
  if (admitted.clock == ClockChange::kBack) StartOver(kJumpedBack);
  if (admitted.clock == ClockChange::kForward)
    StartOver("no IMU for more than a minute, or its clock jumped forward");
  for (const ImuSample& next : admitted.samples) {
    world_->imu_noise_meter.Add(next);
    world_->imu_rhythm.Add(next.t_ns);
  }
  CheckInput(sample.t_ns);
}

void EstimationStage::AddPoints(PointFrame frame) {
  door_.Admit(&frame);
  const int64_t t_ns = frame.t_ns;
  input_check_.AddImage(t_ns);
  if (sync_.AddPoints(std::move(frame))) StartOver(kJumpedBack);
  world_->image_rhythm.Add(t_ns);
  CheckInput(t_ns);
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
      {"imu_saturated", statistics.imu_saturated, statistics.clipping},
      {"imu_stuck", statistics.imu_stuck, statistics.first_imu_stuck},
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
  const double imu_interval = world_->imu_rhythm.Interval();
  if (imu_interval > kMaxImuInterval) {
    return Format("the IMU rate is %.1f Hz; at least %.0f Hz is needed: raise the driver's rate",
                  1 / imu_interval, 1 / kMaxImuInterval);
  }
  const ImuNoise& configured = config_.sensor.imu_noise;
  const ImuNoise& noise = EstimatedNoise();
  ContradictionEvidence evidence;
  evidence.noise_factor = NoiseFactor();
  const bool at_limit = IsAtLimit(noise.accel_density, configured.accel_density) ||
                        IsAtLimit(noise.gyro_density, configured.gyro_density);
  if (evidence.noise_factor < kContradictingNoise && !at_limit) return "";
  const ImuNoiseMeter& meter = world_->imu_noise_meter;
  evidence.imu_jitter = world_->imu_rhythm.Jitter();
  evidence.image_jitter = world_->image_rhythm.Jitter();
  evidence.configured_imu_rate = config_.sensor.imu_rate;
  evidence.imu_rate = imu_interval > 0 ? 1 / imu_interval : evidence.configured_imu_rate;
  evidence.accel_noise_factor = meter.accel_density() / configured.accel_density;
  evidence.gyro_noise_factor = meter.gyro_density() / configured.gyro_density;
  using Rotations = ContradictionEvidence::Rotations;
  if (world_->rotation_checks.front().agrees()) evidence.rotations = Rotations::kAgree;
  if (!FindRotationFault().text.empty()) evidence.rotations = Rotations::kExplained;
  return DescribeContradiction(evidence);
}

const ImuNoise& EstimationStage::EstimatedNoise() const {
  const EstimatorReport& newest = world_->newest;
  return newest.has_pose ? newest.imu_noise : config_.sensor.imu_noise;
}

// The noise scale is that of both sensors; the samples of either may show it, by vibration.
double EstimationStage::NoiseFactor() const {
  const ImuNoise& configured = config_.sensor.imu_noise;
  const ImuNoise& noise = EstimatedNoise();
  const ImuNoiseMeter& samples = world_->imu_noise_meter;
  const double accel =
      noise.accel_density / std::max(configured.accel_density, samples.accel_density());
  const double gyro =
      noise.gyro_density / std::max(configured.gyro_density, samples.gyro_density());
  return std::max({std::sqrt(world_->newest.imu_noise_scale) * std::min(accel, gyro), accel, gyro});
}

const Finding& EstimationStage::InputFinding() const { return world_->input_faults.finding(); }

void EstimationStage::CheckInput(int64_t t_ns) {
  constexpr int64_t kInputsPerCheck = 10;
  if (++inputs_ % kInputsPerCheck == 0) {
    const RankedFinding fault = FindInputFault();
    world_->input_faults.Set(t_ns, fault.text, fault.sigmas);
  }
}

RankedFinding EstimationStage::FindInputFault() const {
  const std::string fault = input_check_.Finding(sync_.imu_door().bursts());
  if (!fault.empty()) return {fault, kFact};
  const RankedFinding rotations = FindRotationFault();
  const RankedFinding lengths = {lengths_->Finding(), lengths_->Contradiction()};
  // A wrong focal length or rotation makes lengths wrong; a wrong length turns no camera.
  const RankedFinding& worst = rotations.text.empty() ? lengths : rotations;
  if (!worst.text.empty()) return worst;
  if (estimator_->ViewMovesAlong()) return {kUnseen, kUnfeltMotion};
  if (!estimator_->SeesUnfeltMotion()) return {};
  return {world_->newest.has_pose ? kUnfeltInFlight : kUnfeltBeforeStart, kUnfeltMotion};
}

// One mistake in the convention of several transforms is named once. If the first one is inverted,
// so are all that do not fit as configured: second cameras of pairs match no points then.
RankedFinding EstimationStage::FindRotationFault() const {
  RankedFinding worst;
  std::string inverted;
  bool are_several = false;
  for (size_t i = 0; i < world_->rotation_checks.size(); ++i) {
    const RotationCheck& check = world_->rotation_checks[i];
    const RankedFinding& found = check.ranked_finding();
    if (found.sigmas > worst.sigmas) worst = found;
    const bool may_be = check.is_inverted() || (found.text.empty() && !check.agrees());
    if (!may_be) continue;
    are_several = !inverted.empty();
    inverted += (are_several ? " and " : "") + TransformKey(static_cast<int>(i));
  }
  if (!world_->rotation_checks.front().is_inverted() || !are_several) return worst;
  return {inverted +
              " are inverted, by the rotations of cameras and gyro: give the cameras in the "
              "IMU frame (T_imu_cam), not the IMU in the camera frames (T_cam_imu)",
          worst.sigmas};
}

void EstimationStage::CheckRotations(const FrameMeasurement& measurement,
                                     const EstimatorOutput& output) {
  const bool in_doubt = !output.has_pose || output.contradicted || output.imu_noise_scale > 1 ||
                        NoiseFactor() > kContradictingNoise || lengths_->Contradiction() > 0;
  world_->doubt.Add(ToSeconds(measurement.imu.back().t_ns - measurement.imu.front().t_ns),
                    in_doubt);
  for (RotationCheck& check : world_->rotation_checks) {
    check.Add(measurement, world_->doubt.IsLong());
  }
}

std::string EstimationStage::LensWarning() const {
  const std::vector<LensMonitor>& lenses = estimator_->lenses();
  for (size_t i = 0; i < lenses.size(); ++i) {
    const std::string& warning = lenses[i].warning();
    if (!warning.empty()) return i == 0 ? warning : Format("camera %zu: ", i) + warning;
  }
  return "";
}

std::vector<ResidualRing> EstimationStage::ResidualRings() const {
  return estimator_->lenses().front().Rings();
}

std::string EstimationStage::SensorFaults() const {
  return DescribeFaults(world_->newest.cameras, world_->newest.depth);
}

void EstimationStage::LearnFrom(const EstimationStage& earlier) {
  lengths_ = std::make_unique<StatedLengths>(*earlier.lengths_);
  lengths_->StartOver();
  estimator_ = std::make_unique<Estimator>(lengths_->Usable(config_));
}

void EstimationStage::Reset(const std::string& reason) {
  sync_.Clear();
  StartOver(reason);
}

// If there was no output since the last start, there is no world frame to end and to announce.
void EstimationStage::StartOver(const std::string& reason) {
  estimator_->Reset();
  lengths_->StartOver();
  world_ = std::make_unique<PerWorld>(config_);
  sync_.SetTimeOffset(estimator_->time_offset());
  if (reinitializing_) return;
  ++resets_;
  restart_reason_ = reason;
  reinitializing_ = true;
}

void EstimationStage::RepeatWithoutWrongLengths() {
  has_found_wrong_length_ = true;
  estimator_ = std::make_unique<Estimator>(lengths_->Usable(config_));
  for (const FrameMeasurement& image : lengths_->images()) {
    estimator_->Process(lengths_->Usable(image));
  }
  sync_.SetTimeOffset(estimator_->time_offset());
  ++resets_;
  restart_reason_ = lengths_->Finding();
}

std::optional<EstimatedFrame> EstimationStage::Process(
    std::optional<FrameMeasurement> measurement) {
  if (!measurement) return std::nullopt;
  if (world_->repeated_images.Add(*measurement, world_->least_speed)) {
    ++frames_repeated_;
    measurement->points.points.clear();
    measurement->lines.reset();
  }
  if (lengths_->Add(*measurement, world_->newest)) RepeatWithoutWrongLengths();
  *measurement = lengths_->Usable(std::move(*measurement));
  EstimatedFrame frame;
  frame.output = estimator_->Process(*measurement);
  frame.points = measurement->points;
  if (measurement->lines) frame.lines = *measurement->lines;
  ++frames_;
  world_->newest = frame.output;
  world_->least_speed = LeastSpeed(frame.output);
  if (frame.output.restarted) ++resets_;
  reinitializing_ = false;
  if (restart_reason_) {
    frame.output.restarted = true;
    frame.output.reason = *std::exchange(restart_reason_, std::nullopt);
  }
  CheckRotations(*measurement, frame.output);
  if (auto& known = frame.output.uncertainty) {
    const double error = world_->rotation_checks.front().error();
    AddScaleDeviation(std::max(lengths_->Doubt(), error), frame.output.state, &*known);
  }
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
