// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator.h"

#include <memory>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/stopwatch.h"
#include "vins_estimator/bridging/frame_placement.h"
#include "vins_estimator/input/measurement_check.h"
#include "vins_estimator/map/recalibration.h"
#include "vins_estimator/map/wandering_lines.h"
#include "vins_estimator/optimization/window_solver.h"
#include "vins_estimator/problem/placed_covariance.h"
#include "vins_estimator/problem/state_covariance.h"
#include "vins_estimator/state/derived_covariance.h"

namespace plm_vins {
namespace {

constexpr int kMaxReweighings = 3;  // each finds three times the noise at most

// Points of an image that hold its state without the window being solved, and which share of them
// may be outliers: a few per cent are.
constexpr int kMinPointsToPlace = 20;
constexpr double kDoubtfulShare = 0.1;

}  // namespace

Estimator::State::State(const Config& config, const EstimatorOptions& options)
    : initializer(config),
      standstill_detector(config.sensor.imu_noise),
      structure(options.same_line),
      estimate(EmptyWindow(config.sensor, options.map)),
      noise(1 / options.problem.point_weight, 1 / options.problem.line_weight),
      imu_noise(config.sensor.imu_noise),
      newest_covariance(Matrix15d::Zero()),
      bridge(config.sensor.imu_noise, estimate.map.window.gravity_W) {
  if (config.sensor.rolling_shutter) rolling_shutter.emplace(config.sensor.camera);
}

Estimator::Estimator(const Config& config)
    : config_(config), options_(config), state_(config, options_) {}

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
  const SlidingWindow& window = state_.estimate.map.window;
  if (state_.rolling_shutter) {
    measurement = state_.rolling_shutter->ToStamp(std::move(measurement), window.T_B_C().rotation,
                                                  window.readout);
  }
  if (options_.problem.estimate_intrinsics) {
    const CameraParameters& camera = config_.sensor.camera;
    Recalibration(camera, camera.With(window.ray_intrinsics)).Move(&measurement);
  }
  return measurement;
}

void Estimator::Use(const FrameMeasurement& measurement, EstimatorOutput* output) {
  const auto standstill = config_.estimator.zero_velocity_update
                              ? state_.standstill_detector.Add(measurement)
                              : std::nullopt;
  if (state_.initialized) {
    Track(measurement, standstill, output);
  } else {
    Initialize(measurement, output);
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
  StartWindow(*result, uncertainty);
  Triangulate(output);
  SolveFirstWindow(output);
  CountLandmarks(output);
  state_.initialized = true;
  Describe(output);
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

void Estimator::StartWindow(const InitializationResult& result,
                            const InitialUncertainty& uncertainty) {
  SlidingWindow& window = state_.estimate.map.window;
  window.SetExtrinsic(result.T_B_C);
  for (const InitialFrame& frame : result.frames) {
    AddFrame(frame.measurement);
    window.newest().state = frame.state;
  }
  window.newest().stationary = result.from_standstill;
  const size_t frames = window.frames.size();
  state_.keyframe = {window.frames[frames > 1 ? frames - 2 : 0].state.t_ns};
  state_.estimate.prior = InitialPrior(uncertainty, options_.problem, window);
}

// Again with the noise of the IMU that the window shows, where it is far from what is configured.
void Estimator::SolveFirstWindow(EstimatorOutput* output) {
  Optimize(options_.first_solution, output);
  for (int i = 0; i < kMaxReweighings; ++i) {
    if (!state_.imu_noise.Reweigh(&state_.estimate.map.window)) return;
    state_.imu_noise.Reset();  // the next solution tells anew
    Optimize(CurrentSolution(), output);
  }
}

void Estimator::Track(const FrameMeasurement& measurement,
                      const std::optional<StandstillDetector::Standstill>& standstill,
                      EstimatorOutput* output) {
  LocalMap& map = state_.estimate.map;
  const bool keep_second_newest = IsKeyframe(options_.keyframes, map.window, map.points);
  if (keep_second_newest) state_.keyframe = {map.window.newest().state.t_ns};
  AddFrame(measurement);
  map.window.SetStillSince(StillSince(standstill));
  PlaceNewest(output);
  const ImuNoiseLearning noise_before = state_.imu_noise;
  bool solve_window = !PlacementSuffices();
  if (solve_window) {
    Triangulate(output);
    FindStructure(keep_second_newest, output);
    Optimize(CurrentSolution(), output);
  }
  const PointMap::Fit fit = FitOfNewest(map.window.newest().state.t_ns);
  if (const auto variance_scale = state_.imu_agreement.Add(map.window, fit)) {
    DoubtInterval(Scaled(state_.imu_noise.noise(), *variance_scale),
                  map.window.newest().motion_since_previous.get());
    state_.imu_noise = noise_before;  // the first solution, which is distorted, teaches nothing
    output->imu_doubted = solve_window = true;
    Optimize(CurrentSolution(), output);
  }
  CountLandmarks(output);
  if (solve_window) LearnFromWindow(output);
  state_.bridge.AddTracked(measurement.imu, {map.window.newest().state, state_.newest_covariance});
  if (const auto failure = CheckEstimate(output->counts)) return GiveUp(*failure, output);
  output->keyframe = keep_second_newest;
  Describe(output);
  SlideWindow(keep_second_newest, output);
}

std::optional<Failure> Estimator::CheckEstimate(const EstimatorCounts& counts) {
  const SlidingWindow& window = state_.estimate.map.window;
  return state_.estimate_monitor.Add({state_.solved, state_.predicted, window.newest().state,
                                      state_.newest_covariance.topLeftCorner<6, 6>(), counts,
                                      window.td - config_.sensor.td});
}

// All but the bridge and the camera's rotation starts over, with the measurement after this one.
void Estimator::GiveUp(const Failure& failure, EstimatorOutput* output) {
  State lost = std::exchange(state_, State(config_, options_));
  state_.newest = lost.newest;
  state_.initializer.KeepRotation(lost.initializer);
  output->status = EstimatorStatus::kLost;
  output->reason = failure.why;
  output->restarted = failure.has_drifted || !lost.bridge.Begin(failure.why);
  if (!output->restarted) state_.bridge = std::move(lost.bridge);
}

// Where points are known they tell a slow motion better than the assumption that there is none.
// Without them, an estimate that is held to the place that it rocks about is better than none.
std::optional<int64_t> Estimator::StillSince(
    const std::optional<StandstillDetector::Standstill>& standstill) const {
  if (!standstill) return std::nullopt;
  const LocalMap& map = state_.estimate.map;
  const bool moves = standstill->common_px > options_.max_motion_at_rest_px;
  if (moves && map.points.MedianDepthInNewest(map.window)) return std::nullopt;
  return standstill->since_ns;
}

void Estimator::AddFrame(const FrameMeasurement& measurement) {
  LocalMap& map = state_.estimate.map;
  WindowFrame frame;
  frame.timing = {measurement.time_offset, map.window.readout, config_.sensor.camera.height};
  if (!map.window.frames.empty()) {
    const FrameState& before = map.window.newest().state;
    const ImuNoise noise = Scaled(state_.imu_noise.noise(), state_.imu_agreement.noise_scale());
    frame.motion_since_previous = std::make_shared<Preintegration>(noise, before.bias());
    for (const ImuSample& sample : measurement.imu) frame.motion_since_previous->Append(sample);
    frame.state = frame.motion_since_previous->Predict(before, map.window.gravity_W);
    frame.motion_since_previous->AllowStampErrors(
        StampErrorsOf(state_.imu_agreement.stamp_deviation(), *frame.motion_since_previous,
                      map.window.gravity_W, before, frame.state));
  }
  frame.state.t_ns = measurement.t_ns;
  state_.predicted = frame.state;
  map.AddFrame(std::move(frame), measurement.points, measurement.lines);
}

void Estimator::Triangulate(EstimatorOutput* output) {
  LocalMap& map = state_.estimate.map;
  map.points.Triangulate(map.window, options_.min_triangulation_angle);
  output->counts.line_triangulation = map.lines.Triangulate(map.window, options_.line_limits);
}

// What the lines say of the scene, and, where a frame is kept, of each other.
void Estimator::FindStructure(bool keep_second_newest, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  LocalMap& map = state_.estimate.map;
  state_.structure.FindAxes(&map);
  if (config_.estimator.line_merging && keep_second_newest) {
    UnitedLines united = state_.structure.Unite(&map);
    output->counts.line_merging = united.merging;
    output->counts.lines_recognised = united.recognised;
    output->absorbed_lines = std::move(united.absorbed);
  }
  output->timings.line_merging = stopwatch.Milliseconds();
}

// With the newest frame it is one more than it keeps.
bool Estimator::WindowIsFull() const {
  const auto frames = static_cast<int>(state_.estimate.map.window.frames.size());
  return frames > config_.estimator.window_size;
}

const SolverOptions& Estimator::CurrentSolution() const {
  return WindowIsFull() ? options_.solution : options_.early_solution;
}

ProblemOptions Estimator::CurrentProblem(JacobiansAt jacobians_at) const {
  ProblemOptions options = options_.problem;
  options.jacobians_at = jacobians_at;
  if (config_.estimator.manhattan_constraints) options.R_W_M = state_.structure.manhattan().R_W_M();
  options.SetNoise(state_.noise.point(), state_.noise.line());
  const LocalMap& map = state_.estimate.map;
  if (map.window.HasStationary()) {
    options.LetPass(options_.passing_flow, map.points.MedianDepthInNewest(map.window));
  }
  return options;
}

// Solves for the states after the newest keyframe, with all else constant: near enough to the
// minimum for the window's equations to be linear, or to leave it at that.
void Estimator::PlaceNewest(EstimatorOutput* output) {
  const Stopwatch stopwatch;
  LocalMap& map = state_.estimate.map;
  const Keyframe& keyframe = state_.keyframe;
  ProblemOptions problem = CurrentProblem(JacobiansAt::kValues);
  problem.estimate_intrinsics = false;  // rays are near enough to those of the intrinsics
  ProblemBuilder builder(problem, &map.window, &state_.estimate.prior);
  builder.AddStatesAfter(keyframe.t_ns, &map.points, &map.lines);
  NormalEquations equations(builder.problem());
  state_.solved =
      SolveBy(config_.estimator.solver, options_.newest_solution, builder.problem(), &equations)
          .solved;
  if (keyframe.covariance) {
    state_.newest_covariance =
        PlacedCovariance(map.window, keyframe.t_ns, *keyframe.covariance, &equations);
  }
  output->timings.optimization += stopwatch.Milliseconds();
}

// Between keyframes, once the window is full, where nothing is in doubt.
bool Estimator::PlacementSuffices() const {
  const SlidingWindow& window = state_.estimate.map.window;
  const bool is_known = state_.solved && state_.keyframe.covariance;
  if (!WindowIsFull() || !is_known || window.newest().stationary) return false;
  if (!state_.imu_agreement.IsUndoubted(window, state_.keyframe.t_ns)) return false;
  const PointMap::Fit fit = FitOfNewest(state_.keyframe.t_ns);
  return fit.seen >= kMinPointsToPlace && fit.contradicted <= kDoubtfulShare * fit.seen;
}

void Estimator::Optimize(const SolverOptions& options, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  LocalMap& map = state_.estimate.map;
  ProblemBuilder builder(CurrentProblem(JacobiansAt::kValues), &map.window, &state_.estimate.prior);
  builder.AddAll(&map.points, &map.lines);
  NormalEquations equations(builder.problem());
  state_.solved = SolveBy(config_.estimator.solver, options, builder.problem(), &equations).solved;
  state_.newest_covariance =
      StateCovariance(map.window.newest().state.t_ns, &equations).value_or(Matrix15d::Zero());
  state_.keyframe.covariance = StateCovariance(state_.keyframe.t_ns, &equations);
  if (config_.estimator.adapt_imu_noise) {
    state_.imu_noise.Learn(map.window, !state_.initialized, &equations);
  }
  if (options_.problem.estimate_intrinsics) {
    FollowIntrinsics(config_.sensor.camera, options_.max_ray_error, &map);
  }
  output->timings.optimization += stopwatch.Milliseconds();  // it may be done twice
}

void Estimator::CountLandmarks(EstimatorOutput* output) const {
  const LocalMap& map = state_.estimate.map;
  output->counts.points_in_window = map.points.CountOptimized();
  output->counts.lines_in_window = map.lines.CountOptimized();
  output->counts.known_seen = map.CountInNewest();
}

PointMap::Fit Estimator::FitOfNewest(int64_t keyframe_ns) const {
  const LocalMap& map = state_.estimate.map;
  return map.points.FitOfNewest(map.window, keyframe_ns, options_.max_reprojection_error);
}

// Which landmarks do not fit, and how noisy features and IMU are.
void Estimator::LearnFromWindow(EstimatorOutput* output) {
  LocalMap& map = state_.estimate.map;
  EstimatorCounts& counts = output->counts;
  counts.points_rejected = map.points.RemoveOutliers(map.window, options_.max_reprojection_error);
  counts.lines_wandering = NoteWandering(map.window, state_.noise.line(), &map.lines);
  counts.lines_rejected = map.lines.RemoveOutliers(map.window, options_.line_limits);
  counts.known_rejected = counts.known_seen - map.CountInNewest();
  if (config_.estimator.adapt_noise) state_.noise.Update(map);
  state_.imu_noise.Reweigh(&map.window);
}

void Estimator::SlideWindow(bool keep_second_newest, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  const LocalMap& map = state_.estimate.map;
  const auto window_size = static_cast<size_t>(config_.estimator.window_size);
  if (!keep_second_newest) {
    state_.estimate.DropSecondNewest();
  } else {
    // Twice right after a start, which may fill a small window by one frame too many.
    while (map.window.frames.size() > window_size) SlideOldest(output);
  }
  output->timings.marginalization = stopwatch.Milliseconds();
}

void Estimator::SlideOldest(EstimatorOutput* output) {
  WindowEstimate& estimate = state_.estimate;
  const bool stays = StaysAsAnchor(options_.anchors, estimate.map.window, estimate.map.lines);
  if (stays) {
    const auto replaced_ns = AnchorToReplace(options_.anchors, estimate.map.window);
    if (replaced_ns) estimate.RemoveAnchor(*replaced_ns);
  }
  const DepartedLandmarks departed =
      estimate.SlideOldest(CurrentProblem(JacobiansAt::kFirstEstimates), stays);
  Append(departed.points, &output->departed_points);
  Append(departed.lines, &output->departed_lines);
}

void Estimator::Describe(EstimatorOutput* output) const {
  const SlidingWindow& window = state_.estimate.map.window;
  output->status = EstimatorStatus::kTracking;
  output->has_pose = true;
  DescribeMap(state_.estimate.map, output);
  output->pose_covariance = state_.newest_covariance.topLeftCorner<6, 6>();
  output->velocity_covariance = state_.newest_covariance.block<3, 3>(6, 6);
  output->body_velocity_covariance =
      BodyVelocityCovariance(output->state, state_.newest_covariance.block<6, 6>(3, 3));
  output->bias_covariance = state_.newest_covariance.bottomRightCorner<6, 6>();
  output->calibration = {config_.sensor.camera.With(window.intrinsics), window.T_B_C(), window.td,
                         window.readout};
  output->R_W_M = state_.structure.manhattan().R_W_M();
  output->imu_noise = state_.imu_noise.noise();
  output->imu_noise_scale = state_.imu_agreement.noise_scale();
  output->delay = state_.imu_agreement.delay();
  output->contradicted = state_.estimate_monitor.contradicted();
  const int fitting = output->counts.known_seen - output->counts.known_rejected;
  output->on_imu_alone =
      state_.estimate_monitor.blind() || (!output->stationary && fitting < kFewFeatures);
}

}  // namespace plm_vins
