// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/initializer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/config/stereo_pairs.h"
#include "common/format.h"
#include "common/imu/imu_samples.h"
#include "vins_estimator/initialization/motion_initializer.h"
#include "vins_estimator/initialization/static_initializer.h"
#include "vins_estimator/structure_from_motion/frame_selection.h"

namespace plm_vins {
namespace {

constexpr double kStandstillDuration = 0.75;  // [s]
constexpr double kQuietDuration = 0.45;       // if the IMU varies by its noise alone [s]
constexpr double kMaxCommonMotion_px = 0.15;  // in that time
constexpr double kMinMotionDuration = 0.745;  // 15 intervals of 20 Hz [s]
// If the IMU shows its noise alone, a scene that moves would fit as well for a moment [s].
constexpr double kMinUnfeltDuration = 1.5;
constexpr double kStereoStandstillDuration = 0.25;
constexpr double kMinStereoMotionDuration = 0.295;  // six intervals of 20 Hz
constexpr double kMaxDuration = 3.0;                // length of the buffer [s]
constexpr int kMinCommonPoints = 12;                // points common to consecutive images
constexpr double kMaxSkipped = 1.0;                 // time without a usable image [s]
constexpr size_t kMinFrames = 6;
constexpr size_t kMinStereoFrames = 4;
constexpr size_t kMaxFrames = 11;
constexpr double kAttemptInterval = 0.095;  // an attempt takes as long as several images [s]

// Returns whether the depth of points is measured in single frames.
bool HasDepth(const SensorConfig& sensor) { return sensor.depth || !StereoPairs(sensor).empty(); }

// Returns the camera with the most points in an image.
int BusiestCamera(const PointFrame& frame, size_t cameras) {
  std::vector<int> points(cameras, 0);
  for (const PointObservation& point : frame.points) ++points[point.camera];
  return static_cast<int>(std::max_element(points.begin(), points.end()) - points.begin());
}

// Drops measured depths, and all observations by other cameras: if initialization with depths
// fails, they may be wrong, so the first window ignores them.
void KeepOnly(int camera, std::vector<FrameMeasurement>* frames) {
  for (FrameMeasurement& frame : *frames) {
    std::vector<PointObservation>& points = frame.points.points;
    points.erase(
        std::remove_if(points.begin(), points.end(),
                       [camera](const PointObservation& point) { return point.camera != camera; }),
        points.end());
    for (PointObservation& point : points) point.depth.reset();
  }
}

std::string TooFewPoints(int count) {
  return "too few points followed from the last image: " + std::to_string(count) + " of " +
         std::to_string(kMinCommonPoints);
}

StandstillDetector::Options StandstillOptions(double duration) {
  StandstillDetector::Options options;
  options.imu.window = duration;
  return options;
}

// Standstill on the ground differs from hovering in that the IMU shows its noise alone.
StandstillDetector::Options QuietOptions() {
  StandstillDetector::Options options = StandstillOptions(kQuietDuration);
  options.imu.min_gyro_deviation = options.imu.min_accel_deviation = 0;
  return options;
}

}  // namespace

Initializer::Initializer(const Config& config)
    : sensor_(config.sensor),
      point_noise_px_(config.estimator.point_noise),
      has_depth_(HasDepth(config.sensor)),
      max_frames_(std::min<size_t>(kMaxFrames, config.estimator.window_size + 1)),
      standstill_(config.sensor.imu_noise,
                  StandstillOptions(has_depth_ ? kStereoStandstillDuration : kStandstillDuration)),
      quiet_standstill_(config.sensor.imu_noise, QuietOptions()) {
  if (sensor_.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) {
    const double focal_length = CameraModel::Create(sensor_.cameras[0].parameters)->FocalLength();
    calibrator_.emplace(sensor_.imu_noise, point_noise_px_ / focal_length);
  }
}

void Initializer::KeepRotation(const Initializer& other) {
  if (other.calibrator_) return;
  SetRotation(other.sensor_.cameras[0].T_B_C.rotation);
  calibrator_.reset();
}

// Rotates the rig: other cameras keep their poses in the first one.
void Initializer::SetRotation(const Eigen::Quaterniond& R_B_C) {
  const Rigid3d T_B_C0 = sensor_.cameras[0].T_B_C;
  const Rigid3d move = Rigid3d(R_B_C, T_B_C0.translation) * T_B_C0.Inverse();
  for (CameraSensor& camera : sensor_.cameras) camera.T_B_C = move * camera.T_B_C;
  sensor_.cameras[0].T_B_C = {R_B_C, T_B_C0.translation};
}

std::vector<Rigid3d> Initializer::Extrinsics() const {
  std::vector<Rigid3d> T_B_C;
  for (const CameraSensor& camera : sensor_.cameras) T_B_C.push_back(camera.T_B_C);
  return T_B_C;
}

void Initializer::StartOver(const std::string& reason) {
  buffer_.clear();
  skipped_imu_.clear();
  standstill_.Reset();
  quiet_standstill_.Reset();
  reason_ = reason;
}

bool Initializer::Skip(const FrameMeasurement& measurement) {
  const size_t points = measurement.points.points.size();
  if (buffer_.empty() || points >= kMinCommonPoints || LeaveGap(measurement.imu)) return false;
  if (ToSeconds(measurement.t_ns - buffer_.back().t_ns) > kMaxSkipped) return false;
  JoinImu(measurement.imu, &skipped_imu_);
  reason_ = TooFewPoints(static_cast<int>(points));
  return true;
}

// Adds an image; drops older ones that IMU samples and tracks do not connect to it. Keeps only the
// last sample of the first image, at the image itself.
void Initializer::Append(const FrameMeasurement& measurement) {
  if (!buffer_.empty() && LeaveGap(measurement.imu)) StartOver("gap in the IMU samples");
  if (!buffer_.empty()) {
    const int common = CountCommonPoints(buffer_.back().points, measurement.points);
    if (common < kMinCommonPoints) StartOver(TooFewPoints(common));
  }
  buffer_.push_back(measurement);
  JoinImu(measurement.imu, &skipped_imu_);
  buffer_.back().imu = std::exchange(skipped_imu_, {});
  if (buffer_.size() == 1) buffer_.front().imu = {measurement.imu.back()};
  while (ToSeconds(buffer_.back().t_ns - buffer_.front().t_ns) > kMaxDuration) buffer_.pop_front();
}

std::optional<InitializationResult> Initializer::Add(const FrameMeasurement& measurement) {
  const bool skipped = Skip(measurement);
  if (!skipped) Append(measurement);
  const FrameMeasurement& added = buffer_.size() > 1 || skipped ? measurement : buffer_.front();
  auto standstill = standstill_.Add(added);
  const auto quiet = quiet_standstill_.Add(added);
  if (skipped) return std::nullopt;
  // A slow take-off looks like standstill for half a second, but its corners move together.
  if (!standstill && quiet && quiet->common_px <= kMaxCommonMotion_px) standstill = quiet;
  if (calibrator_) CalibrateRotation();
  if (calibrator_) return std::nullopt;
  return standstill ? TryStandstill(standstill->since_ns) : TryMotion();
}

std::optional<int64_t> Initializer::begin_ns() const {
  if (buffer_.empty()) return std::nullopt;
  return buffer_.front().t_ns;
}

void Initializer::CalibrateRotation() {
  const auto R_B_C = calibrator_->Add(buffer_, &reason_);
  if (!R_B_C) return;
  SetRotation(*R_B_C);
  calibrator_.reset();
}

std::optional<InitializationResult> Initializer::TryStandstill(int64_t since_ns) {
  std::vector<ImuSample> samples;
  for (const FrameMeasurement& frame : buffer_) {
    if (frame.t_ns > since_ns) JoinImu(frame.imu, &samples);
  }
  auto state = InitializeFromStandstill(samples, sensor_.gravity_norm, &reason_);
  if (!state) return std::nullopt;
  state->t_ns = buffer_.back().t_ns;
  reason_.clear();
  return InitializationResult{{{buffer_.back(), *state}},
                              true,
                              Extrinsics(),
                              std::abs(ExcessOfGravity(samples, sensor_.gravity_norm))};
}

bool Initializer::MayTryMotion(bool stereo) {
  const double duration = ToSeconds(buffer_.back().t_ns - buffer_.front().t_ns);
  const double least = stereo                             ? kMinStereoMotionDuration
                       : standstill_.sees_unfelt_motion() ? kMinUnfeltDuration
                                                          : kMinMotionDuration;
  const size_t min_frames = stereo ? kMinStereoFrames : kMinFrames;
  if (duration >= least && buffer_.size() >= min_frames) return true;
  if (buffer_.size() > 1) {
    reason_ = Format("collecting images: %.1f s of %.1f s", duration, least);
  }
  return false;
}

// If a start with several cameras or depth fails, one camera alone may succeed.
std::optional<InitializationResult> Initializer::TryMotion() {
  if (!MayTryMotion(has_depth_)) return std::nullopt;
  const int64_t now_ns = buffer_.back().t_ns;
  if (last_attempt_ns_ && ToSeconds(now_ns - *last_attempt_ns_) < kAttemptInterval) {
    return std::nullopt;
  }
  last_attempt_ns_ = now_ns;
  MotionInitializerOptions options;
  options.stereo = has_depth_;
  // A short start relies on the prior of the bias, which a larger bias contradicts.
  if (ToSeconds(now_ns - buffer_.front().t_ns) < kMinUnfeltDuration) {
    options.max_accel_bias = std::min(options.max_accel_bias, 2 * sensor_.accel_bias_deviation);
  }
  options.camera = BusiestCamera(buffer_.back().points, sensor_.cameras.size());
  std::vector<FrameMeasurement> frames = JoinFrames(buffer_, SelectFrames(buffer_, max_frames_));
  auto states = InitializeFromMotion(frames, sensor_, point_noise_px_, options, &reason_);
  if (!states && has_depth_) {
    const std::string why = reason_;
    options.stereo = false;
    if (MayTryMotion(options.stereo)) {
      KeepOnly(options.camera, &frames);
      states = InitializeFromMotion(frames, sensor_, point_noise_px_, options, &reason_);
    }
    reason_ = why;
  }
  if (!states) return std::nullopt;
  reason_.clear();
  InitializationResult result;
  result.T_B_C = Extrinsics();
  for (size_t i = 0; i < frames.size(); ++i) {
    result.frames.push_back({std::move(frames[i]), (*states)[i]});
  }
  return result;
}

}  // namespace plm_vins
