// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator.h"

#include <algorithm>
#include <string>
#include <utility>

#include "common/stopwatch.h"
#include "vins_estimator/bridging/frame_placement.h"
#include "vins_estimator/map/recalibration.h"

namespace plm_vins {
namespace {

constexpr char kContradictedStart[] = "all points together contradict the start by a few";

FrameMeasurement WithoutFeatures(FrameMeasurement measurement) {
  measurement.points.points.clear();
  if (measurement.lines) measurement.lines->lines.clear();
  return measurement;
}

}  // namespace

Estimator::PerWorld::PerWorld(const Config& config, const EstimatorOptions& options)
    : initializer(config),
      standstill_detector(config.sensor.imu_noise),
      odometry(config, options),
      bridge(config.sensor.imu_noise, odometry.window().gravity_W) {
  if (config.sensor.rolling_shutter) rolling_shutter.emplace(config.sensor.cameras);
}

Estimator::Estimator(const Config& config)
    : config_(config), options_(config_), world_(config_, options_) {
  for (const CameraSensor& camera : config_.sensor.cameras) {
    lenses_.emplace_back(camera.parameters);
  }
}

void Estimator::Reset() { world_ = PerWorld(config_, options_); }

EstimatorOutput Estimator::Process(const FrameMeasurement& measurement) {
  CheckMeasurement(measurement, world_.newest);
  world_.newest = EndOf(measurement);
  const Stopwatch stopwatch;
  const bool corrects = world_.rolling_shutter || options_.problem.estimate_intrinsics;
  const int points = static_cast<int>(measurement.points.points.size());
  const int lines = measurement.lines ? static_cast<int>(measurement.lines->lines.size()) : 0;
  EstimatorOutput output =
      corrects ? Use(Correct(measurement), points + lines) : Use(measurement, points + lines);
  output.t_ns = measurement.t_ns;
  output.counts.points_observed = points;
  output.counts.lines_observed = lines;
  output.timings.total = stopwatch.Milliseconds();
  return output;
}

FrameMeasurement Estimator::Correct(FrameMeasurement measurement) {
  const SlidingWindow& window = world_.odometry.window();
  if (world_.rolling_shutter) {
    std::vector<Eigen::Quaterniond> R_B_C;
    for (const WindowCamera& camera : window.cameras) R_B_C.push_back(camera.T_B_C().rotation);
    measurement = world_.rolling_shutter->ToStamp(std::move(measurement), R_B_C,
                                                  config_.sensor.ReadoutTime());
  }
  if (options_.problem.estimate_intrinsics) {
    for (size_t i = 0; i < window.cameras.size(); ++i) {
      const CameraParameters& configured = config_.sensor.cameras[i].parameters;
      Recalibration(configured, configured.With(window.cameras[i].ray_intrinsics))
          .Move(static_cast<int>(i), &measurement);
    }
  }
  return measurement;
}

EstimatorOutput Estimator::Use(const FrameMeasurement& measurement, int features_observed) {
  std::optional<StandstillDetector::Standstill> standstill;
  if (config_.estimator.zero_velocity_update) {
    standstill = world_.standstill_detector.Add(measurement, world_.odometry.MedianDepth());
  }
  const StandstillDetector& detector = world_.standstill_detector;
  const bool scene_moves = standstill && standstill->scene_moves;
  const bool may_move = !world_.odometry.started() || detector.doubts_camera();
  const double interval = ToSeconds(measurement.imu.back().t_ns - measurement.imu.front().t_ns);
  world_.unfelt_motion.Add(interval, scene_moves || (may_move && detector.sees_unfelt_motion()));
  world_.unseen_motion.Add(interval, standstill && standstill->view_moves_along);
  if (!world_.odometry.started()) return Initialize(measurement);
  const bool ignores_features = scene_moves || detector.doubts_camera();
  return ignores_features ? Track(WithoutFeatures(measurement), standstill, features_observed)
                          : Track(measurement, standstill, features_observed);
}

EstimatorOutput Estimator::Initialize(const FrameMeasurement& measurement) {
  const Stopwatch stopwatch;
  world_.bridge.AddLost(measurement.imu, measurement.t_ns);
  auto result = world_.initializer.Add(measurement);
  const double milliseconds = stopwatch.Milliseconds();
  std::string reason = world_.initializer.reason();
  EstimatorOutput output;
  if (result) {
    InitialUncertainty uncertainty = UncertaintyOf(config_.sensor, result->from_standstill);
    // A bias along gravity shows; it is hardly larger than those across, which tilt the start.
    uncertainty.accel_bias = std::max(uncertainty.accel_bias, result->accel_bias);
    const bool is_bridged = world_.bridge.begun() && KeepFrame(&*result, &uncertainty);
    auto started = world_.odometry.Start(*result, uncertainty);
    if (started) {
      output = std::move(*started);
      output.bridged = is_bridged;
      output.restarted = world_.bridge.begun() && !is_bridged;
    } else {
      world_.odometry = WindowOdometry(config_, options_);
      reason = kContradictedStart;
    }
  } else {
    output.restarted = !world_.bridge.CanConnect(world_.initializer.begin_ns());
  }
  output.reason = output.restarted ? world_.bridge.why() : reason;
  output.timings.initialization = milliseconds;
  if (output.has_pose || output.restarted) world_.bridge.Clear();
  return output;
}

bool Estimator::KeepFrame(InitializationResult* result, InitialUncertainty* uncertainty) const {
  const FrameState fresh = result->frames.front().state;
  const auto known = world_.bridge.At(fresh.t_ns);
  if (!known || !DifferByFrame(*known, fresh)) return false;
  const FramePlacement placement(known->state, fresh);
  for (InitialFrame& frame : result->frames) frame.state = placement.Apply(frame.state);
  uncertainty->position = PositionDeviation(*known);
  uncertainty->heading = HeadingDeviation(*known);
  return true;
}

EstimatorOutput Estimator::Track(const FrameMeasurement& measurement,
                                 const std::optional<StandstillDetector::Standstill>& standstill,
                                 int features_observed) {
  WindowOdometry::Tracked tracked =
      world_.odometry.Track(measurement, standstill, features_observed);
  world_.bridge.AddTracked(measurement.imu, tracked.newest, tracked.covariance);
  for (size_t i = 0; i < tracked.residuals.size(); ++i) lenses_[i].Add(tracked.residuals[i]);
  if (tracked.failure) {
    tracked.output.status = EstimatorStatus::kLost;
    tracked.output.reason = tracked.failure->why;
    tracked.output.restarted = GiveUp(*tracked.failure);
  }
  return std::move(tracked.output);
}

// Resets everything but the bridge, the camera's rotation and the time without felt motion;
// reinitializes with the next measurement.
bool Estimator::GiveUp(const Failure& failure) {
  PerWorld lost = std::exchange(world_, PerWorld(config_, options_));
  world_.newest = lost.newest;
  world_.unfelt_motion = lost.unfelt_motion;
  world_.unseen_motion = lost.unseen_motion;
  world_.initializer.KeepRotation(lost.initializer);
  const bool begins_world = failure.has_drifted || !lost.bridge.Begin(failure.why);
  if (!begins_world) world_.bridge = std::move(lost.bridge);
  return begins_world;
}

}  // namespace plm_vins
