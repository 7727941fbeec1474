// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator.h"

#include <utility>

#include "common/stopwatch.h"
#include "vins_estimator/bridging/frame_placement.h"
#include "vins_estimator/map/recalibration.h"

namespace plm_vins {
namespace {

FrameMeasurement WithoutFeatures(FrameMeasurement measurement) {
  measurement.points.points.clear();
  if (measurement.lines) measurement.lines->lines.clear();
  return measurement;
}

}  // namespace

Estimator::State::State(const Config& config, const EstimatorOptions& options)
    : initializer(config),
      standstill_detector(config.sensor.imu_noise),
      odometry(config, options),
      bridge(config.sensor.imu_noise, odometry.window().gravity_W) {
  if (config.sensor.rolling_shutter) rolling_shutter.emplace(config.sensor.camera);
}

Estimator::Estimator(const Config& config)
    : config_(config), options_(config_), state_(config_, options_), lens_(config_.sensor.camera) {}

void Estimator::Reset() { state_ = State(config_, options_); }

EstimatorOutput Estimator::Process(const FrameMeasurement& measurement) {
  CheckMeasurement(measurement, state_.newest);
  state_.newest = EndOf(measurement);
  const Stopwatch stopwatch;
  EstimatorOutput output;
  output.t_ns = measurement.t_ns;
  output.counts.points_observed = static_cast<int>(measurement.points.points.size());
  if (measurement.lines) {
    output.counts.lines_observed = static_cast<int>(measurement.lines->lines.size());
  }
  if (state_.rolling_shutter || options_.problem.estimate_intrinsics) {
    Use(Correct(measurement), &output);
  } else {
    Use(measurement, &output);
  }
  output.timings.total = stopwatch.Milliseconds();
  return output;
}

FrameMeasurement Estimator::Correct(FrameMeasurement measurement) {
  const SlidingWindow& window = state_.odometry.window();
  if (state_.rolling_shutter) {
    measurement = state_.rolling_shutter->ToStamp(std::move(measurement), window.T_B_C().rotation,
                                                  config_.sensor.ReadoutTime());
  }
  if (options_.problem.estimate_intrinsics) {
    const CameraParameters& camera = config_.sensor.camera;
    Recalibration(camera, camera.With(window.ray_intrinsics)).Move(&measurement);
  }
  return measurement;
}

void Estimator::Use(const FrameMeasurement& measurement, EstimatorOutput* output) {
  std::optional<StandstillDetector::Standstill> standstill;
  if (config_.estimator.zero_velocity_update) {
    standstill = state_.standstill_detector.Add(measurement, state_.odometry.MedianDepth());
  }
  const bool scene_moves = standstill && standstill->scene_moves;
  if (scene_moves) {
    unfelt_motion_ += ToSeconds(measurement.imu.back().t_ns - measurement.imu.front().t_ns);
  }
  if (!state_.odometry.started()) {
    Initialize(measurement, output);
  } else if (scene_moves || state_.standstill_detector.doubts_camera()) {
    Track(WithoutFeatures(measurement), standstill, output);
  } else {
    Track(measurement, standstill, output);
  }
}

void Estimator::Initialize(const FrameMeasurement& measurement, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  state_.bridge.AddLost(measurement.imu, measurement.t_ns);
  auto result = state_.initializer.Add(measurement);
  output->timings.initialization = stopwatch.Milliseconds();
  output->reason = state_.initializer.reason();
  if (!result) {
    if (!state_.bridge.CanConnect(state_.initializer.begin_ns())) BeginWorld(output);
    return;
  }
  InitialUncertainty uncertainty = UncertaintyOf(config_.sensor, result->from_standstill);
  output->bridged = state_.bridge.begun();
  if (output->bridged && !KeepFrame(&*result, &uncertainty)) BeginWorld(output);
  state_.bridge.Clear();
  state_.odometry.Start(*result, uncertainty, output);
}

bool Estimator::KeepFrame(InitializationResult* result, InitialUncertainty* uncertainty) const {
  const FrameState fresh = result->frames.front().state;
  const UncertainState* known = state_.bridge.At(fresh.t_ns);
  if (known == nullptr || !DifferByFrame(*known, fresh)) return false;
  const FramePlacement placement(known->state, fresh);
  for (InitialFrame& frame : result->frames) frame.state = placement.Apply(frame.state);
  uncertainty->position = PositionDeviation(*known);
  uncertainty->heading = HeadingDeviation(*known);
  return true;
}

void Estimator::BeginWorld(EstimatorOutput* output) {
  output->restarted = true;
  output->bridged = false;
  output->reason = state_.bridge.why();
  state_.bridge.Clear();
}

void Estimator::Track(const FrameMeasurement& measurement,
                      const std::optional<StandstillDetector::Standstill>& standstill,
                      EstimatorOutput* output) {
  const WindowOdometry::Tracked tracked = state_.odometry.Track(measurement, standstill, output);
  state_.bridge.AddTracked(measurement.imu, tracked.newest, tracked.covariance);
  lens_.Add(tracked.residuals);
  if (tracked.failure) GiveUp(*tracked.failure, output);
}

// Resets everything but the bridge and the camera's rotation; reinitializes with the next
// measurement.
void Estimator::GiveUp(const Failure& failure, EstimatorOutput* output) {
  State lost = std::exchange(state_, State(config_, options_));
  state_.newest = lost.newest;
  state_.initializer.KeepRotation(lost.initializer);
  output->status = EstimatorStatus::kLost;
  output->reason = failure.why;
  output->restarted = failure.has_drifted || !lost.bridge.Begin(failure.why);
  if (!output->restarted) state_.bridge = std::move(lost.bridge);
}

}  // namespace plm_vins
