// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/window_odometry.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/stopwatch.h"
#include "vins_estimator/state/derived_covariance.h"
#include "vins_estimator/uncertainty/placed_covariance.h"

namespace plm_vins {
namespace {

constexpr double kNewStart = 1.5;  // [s]

// After a start in motion, velocity and scale depend on the accelerometer alone, whose errors are
// not white: slow vibration, scale. Factor on the stated variance at the start, minus one, and the
// time in which it decays.
constexpr double kNotWhite = 1.0, kDecay = 4;  // [1], [s]

// Returns whether the optimized window is another solution than the initial states, which have
// fewer points but the same measurements: correct starts move by up to a sixth of the path.
bool Contradicts(const SlidingWindow& window, const std::vector<InitialFrame>& initial) {
  constexpr double kMostShare = 0.5, kAlways = 0.05;  // [1], [m]
  double path = 0, change = 0;
  for (size_t i = 0; i < initial.size(); ++i) {
    const Eigen::Vector3d p_W = initial[i].state.position();
    path = std::max(path, (p_W - initial.front().state.position()).norm());
    change = std::max(change, (window.frames[i].state.position() - p_W).norm());
  }
  return change > kMostShare * path + kAlways;
}

}  // namespace

WindowOdometry::WindowOdometry(const Config& config, const EstimatorOptions& options)
    : config_(&config), options_(&options), optimizer_(config, options) {}

std::optional<EstimatorOutput> WindowOdometry::Start(const InitializationResult& result,
                                                     const InitialUncertainty& uncertainty) {
  Fill(result, uncertainty);
  const Step step = optimizer_.SolveFirst();
  if (Contradicts(window(), result.frames)) return std::nullopt;
  started_ = true;
  from_standstill_ = result.from_standstill;
  start_ns_ = window().newest().state.t_ns;
  depth_evidence_.Begin(window().newest().state.position(), !result.from_standstill);
  return Describe(step);
}

void WindowOdometry::Fill(const InitializationResult& result,
                          const InitialUncertainty& uncertainty) {
  WindowEstimate* estimate = optimizer_.mutable_estimate();
  SlidingWindow& window = estimate->map.window;
  for (size_t i = 0; i < window.cameras.size(); ++i) {
    window.cameras[i].SetExtrinsics(result.T_B_C[i]);
  }
  for (const InitialFrame& frame : result.frames) {
    optimizer_.AddFrame(frame.measurement);
    window.newest().state = frame.state;
  }
  window.newest().stationary = result.from_standstill;
  const size_t frames = window.frames.size();
  optimizer_.BeginKeyframe(window.frames[frames > 1 ? frames - 2 : 0].state.t_ns);
  estimate->prior = InitialPrior(uncertainty, options_->problem, window);
}

WindowOdometry::Tracked WindowOdometry::Track(
    const FrameMeasurement& measurement,
    const std::optional<StandstillDetector::Standstill>& standstill, int features_observed) {
  LocalMap& map = optimizer_.mutable_estimate()->map;
  bool keep_second_newest = IsKeyframe(options_->keyframes, map.window, map.points);
  EstimateMonitor::Evidence evidence;
  evidence.predicted = optimizer_.AddFrame(measurement);
  SetStandstill(standstill);
  keep_second_newest |= EndsStandstill(options_->keyframes, map.window);
  if (keep_second_newest) optimizer_.BeginKeyframe(map.window.second_newest().state.t_ns);
  const Step step = optimizer_.Solve(keep_second_newest, estimate_monitor_.blind());
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

// Known depths constrain a slow motion better than standstill does. Without, standstill is safer.
// Shortly after a start it is less certain if the corners move together: the bias of the
// accelerometer is hardly known yet, and would absorb a slow take-off.
void WindowOdometry::SetStandstill(
    const std::optional<StandstillDetector::Standstill>& standstill) {
  SlidingWindow& window = optimizer_.mutable_estimate()->map.window;
  if (standstill && standstill->view_moves_along) {
    window.IgnoreAccelerationSince(standstill->since_ns);
  }
  const bool moves = standstill && standstill->common_px > options_->max_motion_at_rest_px;
  if (!standstill || (moves && MedianDepth())) {
    window.SetStillSince(std::nullopt);
    return;
  }
  const double duration = ToSeconds(window.newest().state.t_ns - standstill->since_ns);
  const double flow = standstill->common_px / options_->focal_length / duration;
  const bool is_new = ToSeconds(window.newest().state.t_ns - start_ns_) < kNewStart;
  window.SetStillSince(standstill->since_ns, moves && is_new ? flow : 0);
}

// Returns none before the window is full: then its middle is another frame at each keyframe.
std::vector<std::vector<PixelResidual>> WindowOdometry::MiddleResiduals() const {
  if (!optimizer_.WindowIsFull()) return {};
  const std::vector<WindowFrame>& frames = window().frames;
  std::vector<std::vector<PixelResidual>> residuals;
  for (const CameraSensor& camera : config_->sensor.cameras) {
    const ImageKey image{frames[frames.size() / 2].state.t_ns, static_cast<int>(residuals.size())};
    residuals.push_back(PixelResiduals(optimizer_.estimate().map, image, camera.parameters));
  }
  return residuals;
}

DepartedLandmarks WindowOdometry::SlideWindow(bool keep_second_newest) {
  const auto window_size = static_cast<size_t>(config_->estimator.window_size);
  DepartedLandmarks departed;
  if (!keep_second_newest) optimizer_.mutable_estimate()->DropSecondNewest();
  // Runs twice right after initialization, which may fill a small window by one extra frame.
  while (keep_second_newest && window().frames.size() > window_size) {
    const DepartedLandmarks more = SlideOldest();
    Append(more.points, &departed.points);
    Append(more.lines, &departed.lines);
  }
  return departed;
}

DepartedLandmarks WindowOdometry::SlideOldest() {
  WindowEstimate* estimate = optimizer_.mutable_estimate();
  const LocalMap& map = estimate->map;
  const bool stays = StaysAsAnchor(options_->anchors, map.window, map.lines);
  if (stays) {
    const auto replaced_ns = AnchorToReplace(options_->anchors, map.window);
    if (replaced_ns) estimate->RemoveAnchor(*replaced_ns);
  }
  return estimate->SlideOldest(optimizer_.CurrentProblem(JacobiansAt::kFirstEstimates), stays);
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
  EstimatorOutput output = Report(step);
  output.status = EstimatorStatus::kTracking;
  output.has_pose = true;
  optimizer_.Describe(&output);
  if (step.solution.covariance) {
    const double age = ToSeconds(output.state.t_ns - start_ns_);
    const double factor = 1 + (from_standstill_ ? 0 : kNotWhite * std::exp(-age / kDecay));
    const Matrix15d covariance = factor * *step.solution.covariance;
    output.uncertainty = {covariance.topLeftCorner<6, 6>(), covariance.block<3, 3>(6, 6),
                          BodyVelocityCovariance(output.state, covariance.block<6, 6>(3, 3)),
                          covariance.bottomRightCorner<6, 6>()};
  }
  output.contradicted = estimate_monitor_.contradicted();
  const int fitting = step.counts.known_seen - step.counts.known_rejected;
  output.on_imu_alone = estimate_monitor_.blind() || (!output.stationary && fitting < kFewFeatures);
  return output;
}

}  // namespace plm_vins
