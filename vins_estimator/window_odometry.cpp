// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/window_odometry.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/stopwatch.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/map/recalibration.h"
#include "vins_estimator/problem/placement_problem.h"
#include "vins_estimator/problem/problem_builder.h"
#include "vins_estimator/solver/window_solver.h"
#include "vins_estimator/state/derived_covariance.h"
#include "vins_estimator/uncertainty/length_evidence.h"
#include "vins_estimator/uncertainty/placed_covariance.h"
#include "vins_estimator/uncertainty/state_covariance.h"

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

WindowOdometry::WindowOdometry(const Config& config, const EstimatorOptions& options)
    : config_(&config),
      options_(&options),
      estimate_(EmptyWindow(config.sensor, options.map)),
      structure_(options.same_line),
      noise_(1 / options.problem.cameras[0].point_weight, 1 / options.problem.line_weight),
      rig_monitor_(options.problem, options.focal_length),
      imu_noise_(config.sensor.imu_noise) {}

EstimatorOutput WindowOdometry::Start(const InitializationResult& result,
                                      const InitialUncertainty& uncertainty) {
  Fill(result, uncertainty);
  const Step step = SolveFirstWindow();
  started_ = true;
  depth_evidence_.Begin(window().newest().state.position(), !result.from_standstill);
  return Describe(step);
}

void WindowOdometry::Fill(const InitializationResult& result,
                          const InitialUncertainty& uncertainty) {
  SlidingWindow& window = estimate_.map.window;
  for (size_t i = 0; i < window.cameras.size(); ++i) {
    window.cameras[i].SetExtrinsics(result.T_B_C[i]);
  }
  for (const InitialFrame& frame : result.frames) {
    AddFrame(frame.measurement);
    window.newest().state = frame.state;
  }
  window.newest().stationary = result.from_standstill;
  const size_t frames = window.frames.size();
  keyframe_ = {window.frames[frames > 1 ? frames - 2 : 0].state.t_ns};
  estimate_.prior = InitialPrior(uncertainty, options_->problem, window);
}

// Repeats the solution with the estimated IMU noise if that is far from the configured one.
WindowOdometry::Step WindowOdometry::SolveFirstWindow() {
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
  return step;
}

WindowOdometry::Tracked WindowOdometry::Track(
    const FrameMeasurement& measurement,
    const std::optional<StandstillDetector::Standstill>& standstill, int features_observed) {
  LocalMap& map = estimate_.map;
  bool keep_second_newest = IsKeyframe(options_->keyframes, map.window, map.points);
  EstimateMonitor::Evidence evidence;
  evidence.predicted = AddFrame(measurement);
  map.window.SetStillSince(StillSince(standstill));
  keep_second_newest |= EndsStandstill(options_->keyframes, map.window);
  if (keep_second_newest) keyframe_ = {map.window.second_newest().state.t_ns};
  const Step step = Solve(keep_second_newest);
  Tracked tracked;
  tracked.newest = map.window.newest().state;
  tracked.covariance = step.solution.covariance;
  depth_evidence_.Add(tracked.newest.position(), tracked.covariance);
  depth_evidence_.AddMeasured(step.counts.matched.used + step.counts.depth.used);
  evidence.solved = step.solution.exists;
  evidence.stationary = map.window.newest().stationary;
  evidence.newest = tracked.newest;
  evidence.pose_covariance = PoseOf(tracked.covariance);
  evidence.features_observed = features_observed;
  evidence.counts = step.counts;
  evidence.time_offset_change = map.window.td - config_->sensor.td;
  evidence.longest_imu_gap = map.window.LongestImuInterval();
  tracked.failure = estimate_monitor_.Add(evidence);
  tracked.output = tracked.failure ? Report(step) : Describe(step);
  if (tracked.failure) return tracked;
  if (keep_second_newest) tracked.residuals = MiddleResiduals();
  tracked.output.keyframe = keep_second_newest;
  const Stopwatch stopwatch;
  DepartedLandmarks departed = SlideWindow(keep_second_newest);
  tracked.output.timings.marginalization = stopwatch.Milliseconds();
  tracked.output.departed_points = std::move(departed.points);
  tracked.output.departed_lines = std::move(departed.lines);
  return tracked;
}

WindowOdometry::Step WindowOdometry::Solve(bool keep_second_newest) {
  Step step;
  const ImuNoiseLearning noise_before = imu_noise_;
  if (estimate_monitor_.blind() && estimate_.map.CountInNewest() >= kFewFeatures) {
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

bool WindowOdometry::DoubtsNewestInterval() {
  const SlidingWindow& window = estimate_.map.window;
  const auto variance_scale = imu_agreement_.Add(window, FitOfNewest(window.newest().state.t_ns));
  if (!variance_scale) return false;
  DoubtInterval(Scaled(imu_noise_.noise(), *variance_scale),
                window.newest().motion_since_previous.get());
  return true;
}

// Known depths constrain a slow motion better than standstill does; without, standstill is safer.
std::optional<int64_t> WindowOdometry::StillSince(
    const std::optional<StandstillDetector::Standstill>& standstill) const {
  if (!standstill) return std::nullopt;
  const bool moves = standstill->common_px > options_->max_motion_at_rest_px;
  if (moves && MedianDepth()) return std::nullopt;
  return standstill->since_ns;
}

FrameState WindowOdometry::AddFrame(const FrameMeasurement& measurement) {
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

LineTriangulationCounts WindowOdometry::Triangulate() {
  LocalMap& map = estimate_.map;
  rig_monitor_.DropUnfit(&map);
  map.points.Triangulate(map.window, options_->min_triangulation_angle,
                         options_->unnoticed_turn_rate);
  return map.lines.Triangulate(map.window, options_->line_limits);
}

// Finds the Manhattan frame and, at keyframes, merges and recognizes lines.
UnitedLines WindowOdometry::FindStructure(bool keep_second_newest) {
  structure_.FindAxes(&estimate_.map);
  if (!config_->estimator.line_merging || !keep_second_newest) return {};
  return structure_.Unite(&estimate_.map);
}

// The newest frame counts in addition to the window size.
bool WindowOdometry::WindowIsFull() const {
  return static_cast<int>(estimate_.map.window.frames.size()) > config_->estimator.window_size;
}

const SolverOptions& WindowOdometry::CurrentSolution() const {
  return WindowIsFull() ? options_->solution : options_->early_solution;
}

ProblemOptions WindowOdometry::CurrentProblem(JacobiansAt jacobians_at) const {
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
WindowOdometry::Solution WindowOdometry::PlaceNewest() {
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
bool WindowOdometry::Suffices(const Solution& placement) const {
  const SlidingWindow& window = estimate_.map.window;
  const bool is_known = placement.exists && keyframe_.covariance;
  if (!WindowIsFull() || !is_known || window.newest().stationary) return false;
  if (!imu_agreement_.IsUndoubted(window, keyframe_.t_ns)) return false;
  const PointMap::Fit fit = FitOfNewest(keyframe_.t_ns);
  return fit.seen >= kMinPointsToPlace && fit.contradicted <= kDoubtfulShare * fit.seen;
}

// Recovers after blindness: dead reckoning may have drifted so far that all known landmarks are
// outliers and do not constrain the estimate any more. Wide losses first make the minimum reachable
// that most landmarks agree on (graduated non-convexity, [Yang2020]).
double WindowOdometry::FindBack() {
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

WindowOdometry::Solution WindowOdometry::SolveWindow(const SolverOptions& options) {
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
  if (config_->sensor.depth) depth_faults_ = FaultsOfDepths(map.window, &equations);
  if (config_->estimator.adapt_imu_noise) {
    imu_noise_.Learn(map.window, !started_, &equations);
  }
  if (options_->problem.estimate_intrinsics) {
    FollowIntrinsics(config_->sensor, options_->max_ray_error, &map);
  }
  solution.milliseconds = stopwatch.Milliseconds();
  return solution;
}

EstimatorCounts WindowOdometry::CountLandmarks() const {
  const LocalMap& map = estimate_.map;
  EstimatorCounts counts;
  counts.points_in_window = map.points.CountOptimized();
  counts.lines_in_window = map.lines.CountOptimized();
  counts.known_seen = map.CountInNewest();
  return counts;
}

// Returns none before the window is full: then its middle is another frame at each keyframe.
std::vector<std::vector<PixelResidual>> WindowOdometry::MiddleResiduals() const {
  if (!WindowIsFull()) return {};
  const std::vector<WindowFrame>& frames = estimate_.map.window.frames;
  std::vector<std::vector<PixelResidual>> residuals;
  for (const CameraSensor& camera : config_->sensor.cameras) {
    const ImageKey image{frames[frames.size() / 2].state.t_ns, static_cast<int>(residuals.size())};
    residuals.push_back(PixelResiduals(estimate_.map, image, camera.parameters));
  }
  return residuals;
}

PointMap::Fit WindowOdometry::FitOfNewest(int64_t keyframe_ns) const {
  return estimate_.map.points.FitOfNewest(window(), keyframe_ns, options_->max_reprojection_error);
}

// Removes outliers and updates the noise of features and IMU. Counts the landmarks before that.
EstimatorCounts WindowOdometry::LearnFromWindow() {
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

DepartedLandmarks WindowOdometry::SlideWindow(bool keep_second_newest) {
  const auto window_size = static_cast<size_t>(config_->estimator.window_size);
  DepartedLandmarks departed;
  if (!keep_second_newest) estimate_.DropSecondNewest();
  // Runs twice right after initialization, which may fill a small window by one extra frame.
  while (keep_second_newest && estimate_.map.window.frames.size() > window_size) {
    const DepartedLandmarks more = SlideOldest();
    Append(more.points, &departed.points);
    Append(more.lines, &departed.lines);
  }
  return departed;
}

DepartedLandmarks WindowOdometry::SlideOldest() {
  const bool stays = StaysAsAnchor(options_->anchors, estimate_.map.window, estimate_.map.lines);
  if (stays) {
    const auto replaced_ns = AnchorToReplace(options_->anchors, estimate_.map.window);
    if (replaced_ns) estimate_.RemoveAnchor(*replaced_ns);
  }
  return estimate_.SlideOldest(CurrentProblem(JacobiansAt::kFirstEstimates), stays);
}

EstimatorOutput WindowOdometry::Report(const Step& step) const {
  EstimatorOutput output;
  output.counts = step.counts;
  output.counts.line_triangulation = step.triangulation;
  output.counts.line_merging = step.lines.merging;
  output.counts.lines_recognized = step.lines.recognized;
  output.absorbed_lines = step.lines.absorbed;
  output.imu_doubted = step.imu_doubted;
  output.timings = step.timings;
  return output;
}

EstimatorOutput WindowOdometry::Describe(const Step& step) const {
  const SlidingWindow& window = estimate_.map.window;
  EstimatorOutput output = Report(step);
  output.status = EstimatorStatus::kTracking;
  output.has_pose = true;
  DescribeMap(estimate_.map, &output);
  if (const auto& covariance = step.solution.covariance) {
    output.uncertainty = {covariance->topLeftCorner<6, 6>(), covariance->block<3, 3>(6, 6),
                          BodyVelocityCovariance(output.state, covariance->block<6, 6>(3, 3)),
                          covariance->bottomRightCorner<6, 6>()};
  }
  output.calibration = CalibrationIn(window, config_->sensor);
  output.cameras = rig_monitor_.Faults();
  output.depth = depth_faults_;
  output.R_W_M = structure_.manhattan().R_W_M();
  output.imu_noise = imu_noise_.noise();
  output.imu_noise_scale = imu_agreement_.noise_scale();
  output.contradicted = estimate_monitor_.contradicted();
  const int fitting = step.counts.known_seen - step.counts.known_rejected;
  output.on_imu_alone = estimate_monitor_.blind() || (!output.stationary && fitting < kFewFeatures);
  return output;
}

}  // namespace plm_vins
