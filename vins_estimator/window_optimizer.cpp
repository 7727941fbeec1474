// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/window_optimizer.h"

#include <memory>
#include <utility>

#include "common/stopwatch.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/failure/failure_detector.h"
#include "vins_estimator/map/recalibration.h"
#include "vins_estimator/problem/placement_problem.h"
#include "vins_estimator/problem/problem_builder.h"
#include "vins_estimator/solver/window_solver.h"
#include "vins_estimator/uncertainty/length_evidence.h"
#include "vins_estimator/uncertainty/placed_covariance.h"

namespace plm_vins {
namespace {

constexpr int kMaxReweighings = 3;  // each increases the noise by at most three times

// Least number of points that constrain the newest state without optimizing the window, and
// greatest share of outliers among them (normally a few percent).
constexpr int kMinPointsToPlace = 20;
constexpr double kDoubtfulShare = 0.1;

// Widens the robust losses after blindness: outliers of about ten pixels keep almost full weight.
constexpr double kWidened = 30;

}  // namespace

WindowOptimizer::WindowOptimizer(const Config& config, const EstimatorOptions& options)
    : config_(&config),
      options_(&options),
      estimate_(EmptyWindow(config.sensor, options.map)),
      structure_(options.same_line),
      noise_(1 / options.problem.cameras[0].point_weight, 1 / options.problem.line_weight),
      rig_monitor_(options.problem, options.focal_length),
      imu_noise_(config.sensor.imu_noise) {}

FrameState WindowOptimizer::AddFrame(const FrameMeasurement& measurement) {
  LocalMap& map = estimate_.map;
  WindowFrame frame;
  frame.cut_time_offset = measurement.time_offset;
  if (!map.window.frames.empty()) {
    const FrameState& before = map.window.newest().state;
    const ImuNoise noise = Scaled(imu_noise_.noise(), imu_agreement_.noise_scale());
    frame.motion_since_previous = std::make_shared<Preintegration>(noise, before.bias());
    for (const ImuSample& sample : measurement.imu) frame.motion_since_previous->Append(sample);
    frame.state = frame.motion_since_previous->Predict(before, map.window.gravity_W);
    frame.motion_since_previous->AllowStampErrors(
        StampErrorsOf(imu_agreement_.stamp_deviation(), *frame.motion_since_previous,
                      map.window.gravity_W, before, frame.state));
  }
  frame.state.t_ns = measurement.t_ns;
  const FrameState predicted = frame.state;
  map.AddFrame(std::move(frame), measurement.points, measurement.lines);
  return predicted;
}

// Repeats the solution with the estimated IMU noise if that is far from the configured one.
WindowOptimizer::Step WindowOptimizer::SolveFirst() {
  is_first_ = true;
  Step step;
  step.triangulation = Triangulate();
  step.Take(SolveWindow(options_->first_solution));
  for (int i = 0; i < kMaxReweighings; ++i) {
    if (!imu_noise_.Reweigh(&estimate_.map.window)) break;
    imu_noise_.Reset();  // re-estimated from the next solution
    step.Take(SolveWindow(CurrentSolution()));
  }
  const DepthCounts matched = rig_monitor_.Judge(&estimate_.map);
  step.counts = CountLandmarks();
  step.counts.matched = matched;
  is_first_ = false;
  return step;
}

WindowOptimizer::Step WindowOptimizer::Solve(bool keep_second_newest, bool was_blind) {
  Step step;
  const ImuNoiseLearning noise_before = imu_noise_;
  if (was_blind && estimate_.map.CountInNewest() >= kFewFeatures) {
    step.timings.optimization = FindBack();
  }
  step.Take(PlaceNewest());
  bool window_is_solved = !Suffices(step.solution);
  if (window_is_solved) {
    step.triangulation = Triangulate();
    const Stopwatch stopwatch;
    step.lines = FindStructure(keep_second_newest);
    step.timings.line_merging = stopwatch.Milliseconds();
    step.Take(SolveWindow(CurrentSolution()));
  }
  if (DoubtsNewestInterval()) {
    imu_noise_ = noise_before;  // the first solution is distorted
    step.imu_doubted = window_is_solved = true;
    step.Take(SolveWindow(CurrentSolution()));
  }
  step.counts = window_is_solved ? LearnFromWindow() : CountLandmarks();
  return step;
}

LineTriangulationCounts WindowOptimizer::Triangulate() {
  LocalMap& map = estimate_.map;
  rig_monitor_.DropUnfit(&map);
  map.points.Triangulate(map.window, options_->min_triangulation_angle,
                         options_->unnoticed_turn_rate);
  return map.lines.Triangulate(map.window, options_->line_limits);
}

// Finds the Manhattan frame and, at keyframes, merges and recognizes lines.
UnitedLines WindowOptimizer::FindStructure(bool keep_second_newest) {
  structure_.FindAxes(&estimate_.map);
  if (!config_->estimator.line_merging || !keep_second_newest) return {};
  return structure_.Unite(&estimate_.map);
}

// The newest frame counts in addition to the window size.
bool WindowOptimizer::WindowIsFull() const {
  return static_cast<int>(estimate_.map.window.frames.size()) > config_->estimator.window_size;
}

const SolverOptions& WindowOptimizer::CurrentSolution() const {
  return WindowIsFull() ? options_->solution : options_->early_solution;
}

ProblemOptions WindowOptimizer::CurrentProblem(JacobiansAt jacobians_at) const {
  ProblemOptions options = options_->problem;
  options.jacobians_at = jacobians_at;
  if (config_->estimator.manhattan_constraints) options.R_W_M = structure_.manhattan().R_W_M();
  options.SetNoise(noise_.point(), noise_.line());
  const LocalMap& map = estimate_.map;
  rig_monitor_.SetWeights(map.window.newest().state.t_ns, &options);
  if (map.window.HasStationary()) {
    options.LetPass(options_->passing_flow, map.points.MedianDepthInNewest(map.window));
  }
  return options;
}

// Estimates the states after the newest keyframe with everything else held fixed. The result is
// close enough to the minimum for the window's equations to be linear, or to be used as it is.
WindowOptimizer::Solution WindowOptimizer::PlaceNewest() {
  const Stopwatch stopwatch;
  LocalMap& map = estimate_.map;
  const PlacementProblem placement(CurrentProblem(JacobiansAt::kValues), &map, keyframe_.t_ns);
  NormalEquations equations(placement.problem());
  Solution solution;
  solution.exists =
      SolveBy(config_->estimator.solver, options_->newest_solution, placement.problem(), &equations)
          .solved;
  if (keyframe_.covariance) {
    solution.covariance =
        PlacedCovariance(map.window, keyframe_.t_ns, *keyframe_.covariance, &equations);
  }
  solution.milliseconds = stopwatch.Milliseconds();
  return solution;
}

// Returns whether the window need not be optimized: between keyframes, once the window is full, if
// nothing is in doubt.
bool WindowOptimizer::Suffices(const Solution& placement) const {
  const SlidingWindow& window = estimate_.map.window;
  const bool is_known = placement.exists && keyframe_.covariance;
  if (!WindowIsFull() || !is_known) return false;
  if (!imu_agreement_.IsUndoubted(window, keyframe_.t_ns)) return false;
  const PointMap::Fit fit = FitOfNewest(keyframe_.t_ns);
  return fit.seen >= kMinPointsToPlace && fit.contradicted <= kDoubtfulShare * fit.seen;
}

// Recovers after blindness: dead reckoning may have drifted so far that all known landmarks are
// outliers and do not constrain the estimate any more. Wide losses first make the minimum reachable
// that most landmarks agree on (graduated non-convexity, [Yang2020]).
double WindowOptimizer::FindBack() {
  const Stopwatch stopwatch;
  LocalMap& map = estimate_.map;
  ProblemOptions problem = CurrentProblem(JacobiansAt::kValues);
  problem.point_loss_scale *= kWidened;
  problem.line_loss_scale *= kWidened;
  ProblemBuilder builder(problem, &map.window, &estimate_.prior);
  builder.AddAll(&map.points, &map.lines);
  NormalEquations equations(builder.problem());
  SolveBy(config_->estimator.solver, CurrentSolution(), builder.problem(), &equations);
  return stopwatch.Milliseconds();
}

WindowOptimizer::Solution WindowOptimizer::SolveWindow(const SolverOptions& options) {
  const Stopwatch stopwatch;
  LocalMap& map = estimate_.map;
  ProblemBuilder builder(CurrentProblem(JacobiansAt::kValues), &map.window, &estimate_.prior);
  builder.AddAll(&map.points, &map.lines);
  NormalEquations equations(builder.problem());
  Solution solution;
  solution.exists =
      SolveBy(config_->estimator.solver, options, builder.problem(), &equations).solved;
  solution.covariance = StateCovariance(map.window.newest().state.t_ns, &equations);
  keyframe_.covariance = StateCovariance(keyframe_.t_ns, &equations);
  rig_monitor_.JudgeBaselines(map.window, &equations);
  if (config_->sensor.depth) {
    depth_faults_ = FaultsOfDepths(map.window, options_->focal_length, &equations);
  }
  if (config_->estimator.adapt_imu_noise) {
    imu_noise_.Learn(map.window, is_first_, &equations);
  }
  if (options_->problem.estimate_intrinsics) {
    FollowIntrinsics(config_->sensor, options_->max_ray_error, &map);
  }
  solution.milliseconds = stopwatch.Milliseconds();
  return solution;
}

bool WindowOptimizer::DoubtsNewestInterval() {
  const SlidingWindow& window = estimate_.map.window;
  const auto variance_scale = imu_agreement_.Add(window, FitOfNewest(window.newest().state.t_ns));
  if (!variance_scale) return false;
  DoubtInterval(Scaled(imu_noise_.noise(), *variance_scale),
                window.newest().motion_since_previous.get());
  return true;
}

PointMap::Fit WindowOptimizer::FitOfNewest(int64_t keyframe_ns) const {
  return estimate_.map.points.FitOfNewest(estimate_.map.window, keyframe_ns,
                                          options_->max_reprojection_error);
}

EstimatorCounts WindowOptimizer::CountLandmarks() const {
  const LocalMap& map = estimate_.map;
  EstimatorCounts counts;
  counts.points_in_window = map.points.CountOptimized();
  counts.lines_in_window = map.lines.CountOptimized();
  counts.known_seen = map.CountInNewest();
  return counts;
}

// Removes outliers and updates the noise of features and IMU. Counts the landmarks before that.
EstimatorCounts WindowOptimizer::LearnFromWindow() {
  LocalMap& map = estimate_.map;
  EstimatorCounts counts = CountLandmarks();
  counts.points_rejected = map.points.RemoveOutliers(map.window, options_->max_reprojection_error);
  counts.matched = rig_monitor_.Judge(&map);
  if (config_->sensor.depth) {
    counts.depth = map.points.RemoveDepthOutliers(map.window, options_->max_inverse_depth_error);
  }
  counts.lines_rejected = map.lines.RemoveOutliers(map.window, options_->line_limits);
  counts.known_rejected = counts.known_seen - map.CountInNewest();
  if (config_->estimator.adapt_noise) noise_.Update(map);
  imu_noise_.Reweigh(&map.window);
  return counts;
}

void WindowOptimizer::Describe(EstimatorOutput* output) const {
  DescribeMap(estimate_.map, output);
  output->calibration = CalibrationIn(estimate_.map.window, config_->sensor);
  output->cameras = rig_monitor_.Faults();
  output->depth = depth_faults_;
  output->R_W_M = structure_.manhattan().R_W_M();
  output->imu_noise = imu_noise_.noise();
  output->imu_noise_scale = imu_agreement_.noise_scale();
}

}  // namespace plm_vins
