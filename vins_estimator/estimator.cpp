// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator.h"

#include <cmath>
#include <memory>
#include <utility>

#include "common/stopwatch.h"
#include "vins_estimator/manhattan/line_directions.h"
#include "vins_estimator/optimization/ceres_solver.h"

namespace plm_vins {
namespace {

constexpr double kMinTriangulationAngle_px = 2.0;  // in pixels of motion: well above corner noise
constexpr double kMaxReprojectionError_px = 3.0;   // mean over a landmark's views
constexpr int kInitialIterations = 20;
constexpr size_t kMinViewsToOptimize = 3;
// What an anchor has seen of a line that comes back is part of the prior already, and the line may
// be another one that looks the same; so it counts less.
constexpr double kAnchorNoise = 5.0;  // in units of the noise of lines

template <typename Landmark>
bool IsOptimized(const Landmark& landmark) {
  return landmark.triangulated && landmark.views.size() >= kMinViewsToOptimize;
}

ProblemOptions MakeProblemOptions(const Config& config, double focal_length) {
  ProblemOptions options;
  options.point_weight = focal_length / config.estimator.point_noise;
  options.line_weight = focal_length / config.estimator.line_noise;
  options.anchor_weight = options.line_weight / kAnchorNoise;
  options.manhattan_weight = 180 / (M_PI * config.estimator.manhattan_noise);
  options.estimate_extrinsic =
      config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed;
  options.estimate_td = config.sensor.estimate_td;
  return options;
}

InitialUncertainty UncertaintyOf(const SensorConfig& sensor, bool from_standstill) {
  InitialUncertainty uncertainty;
  if (from_standstill) {
    uncertainty.velocity = 0.03;
    uncertainty.gyro_bias = 0.003;
  }
  if (sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) {
    uncertainty.extrinsic_rotation = 0.1;
    uncertainty.extrinsic_position = 0.1;
  }
  return uncertainty;
}

LineTriangulationOptions MakeLineTriangulationOptions(const Config& config, double focal_length) {
  LineTriangulationOptions options;
  options.noise = config.estimator.line_noise / focal_length;
  return options;
}

LineLimits MakeLineLimits(const Config& config, double focal_length) {
  LineLimits limits;
  limits.noise = config.estimator.line_noise / focal_length;
  limits.max_length = config.estimator.line_outlier_distance;
  return limits;
}

LineMergingOptions MakeLineMergingOptions(const Config& config, double focal_length) {
  LineMergingOptions options;
  options.distance = config.estimator.line_merge_distance;
  options.image_distance = config.estimator.line_merge_image_distance / focal_length;
  options.angle = config.estimator.line_merge_angle * M_PI / 180;
  options.noise = config.estimator.line_noise / focal_length;
  return options;
}

KeyframePolicyOptions MakeKeyframeOptions(const Config& config, double focal_length) {
  KeyframePolicyOptions options;
  options.min_parallax = config.estimator.keyframe_parallax / focal_length;
  return options;
}

AnchorPolicyOptions MakeAnchorOptions(const EstimatorConfig& config) {
  AnchorPolicyOptions options;
  options.max_anchors = config.line_merging ? static_cast<size_t>(config.line_anchors) : 0;
  return options;
}

}  // namespace

Estimator::Estimator(const Config& config)
    : config_(config),
      focal_length_(CameraModel::Create(config.sensor.camera)->FocalLength()),
      line_triangulation_options_(MakeLineTriangulationOptions(config, focal_length_)),
      line_limits_(MakeLineLimits(config, focal_length_)),
      keyframe_options_(MakeKeyframeOptions(config, focal_length_)),
      anchor_options_(MakeAnchorOptions(config.estimator)),
      initializer_(config),
      standstill_detector_(config.sensor.imu_noise),
      line_merging_(MakeLineMergingOptions(config, focal_length_)) {
  Reset();
}

void Estimator::Reset() {
  initialized_ = false;
  initializer_.Reset();
  standstill_detector_.Reset();
  contradiction_monitor_.Reset();
  window_ = SlidingWindow();
  window_.SetExtrinsic(config_.sensor.T_B_C);
  window_.td = config_.sensor.td;
  window_.gravity_W = Eigen::Vector3d(0, 0, -config_.sensor.gravity_norm);
  points_.Clear();
  lines_.Clear();
  manhattan_ = ManhattanFrame();
  line_merging_.Clear();
  problem_options_ = MakeProblemOptions(config_, focal_length_);
  prior_ = MarginalizationPrior();
}

EstimatorOutput Estimator::Process(const FrameMeasurement& measurement) {
  const Stopwatch stopwatch;
  EstimatorOutput output;
  output.t_ns = measurement.t_ns;
  output.counts.points_observed = static_cast<int>(measurement.points.points.size());
  if (measurement.lines) {
    output.counts.lines_observed = static_cast<int>(measurement.lines->lines.size());
  }
  const bool stands_still = StandsStill(measurement);
  if (initialized_) {
    Track(measurement, stands_still, &output);
  } else {
    Initialize(measurement, &output);
  }
  output.timings.total = stopwatch.Milliseconds();
  return output;
}

void Estimator::Initialize(const FrameMeasurement& measurement, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  const auto result = initializer_.Add(measurement);
  output->timings.initialization = stopwatch.Milliseconds();
  output->reason = initializer_.reason();
  if (!result) return;

  StartWindow(*result);
  Triangulate(output);
  Optimize(kInitialIterations, output);
  initialized_ = true;
  output->reason.clear();
  Describe(output);
}

void Estimator::StartWindow(const InitializationResult& result) {
  window_.SetExtrinsic(result.T_B_C);
  for (const InitialFrame& frame : result.frames) {
    AddFrame(frame.measurement);
    window_.newest().state = frame.state;
  }
  prior_ = InitialPrior(UncertaintyOf(config_.sensor, result.from_standstill), problem_options_,
                        window_);
}

void Estimator::Track(const FrameMeasurement& measurement, bool stands_still,
                      EstimatorOutput* output) {
  const bool keep_second_newest = IsKeyframe(keyframe_options_, window_, points_);
  AddFrame(measurement);
  window_.newest().stationary = stands_still;
  Triangulate(output);
  FindStructure(output);
  Optimize(config_.estimator.max_num_iterations, output);
  RemoveOutliers(output);
  if (const auto failure = FindFailure(*output)) {
    Reset();
    output->status = EstimatorStatus::kLost;
    output->reason = *failure;
    output->restarted = true;
    return;
  }
  output->keyframe = keep_second_newest;
  Describe(output);
  SlideWindow(keep_second_newest, output);
}

std::optional<std::string> Estimator::FindFailure(const EstimatorOutput& output) {
  const auto contradiction = contradiction_monitor_.Add(output.t_ns, output.counts.points_in_window,
                                                        output.counts.points_rejected);
  return contradiction ? contradiction
                       : DetectFailure(FailureLimits(), predicted_, window_.newest().state);
}

bool Estimator::StandsStill(const FrameMeasurement& measurement) {
  return config_.estimator.zero_velocity_update && standstill_detector_.Add(measurement);
}

void Estimator::AddFrame(const FrameMeasurement& measurement) {
  WindowFrame frame;
  frame.state.t_ns = measurement.t_ns;
  frame.cut_time_offset = measurement.time_offset;
  if (!window_.frames.empty()) {
    const FrameState& before = window_.newest().state;
    frame.motion_since_previous =
        std::make_shared<Preintegration>(config_.sensor.imu_noise, before.bias());
    for (const ImuSample& sample : measurement.imu) frame.motion_since_previous->Append(sample);
    frame.state = frame.motion_since_previous->Predict(before, window_.gravity_W);
    frame.state.t_ns = measurement.t_ns;
  }
  predicted_ = frame.state;
  window_.frames.push_back(std::move(frame));
  points_.AddFrame(measurement.points, measurement.time_offset);
  if (measurement.lines) lines_.AddFrame(line_merging_.Redirect(*measurement.lines));
}

void Estimator::Triangulate(EstimatorOutput* output) {
  points_.Triangulate(window_, kMinTriangulationAngle_px / focal_length_);
  output->counts.line_triangulation =
      lines_.Triangulate(window_, line_triangulation_options_, line_limits_.max_length);
}

// The Manhattan frame of the lines, and which of them are one.
void Estimator::FindStructure(EstimatorOutput* output) {
  const Stopwatch stopwatch;
  const auto directions = LineDirections(window_, lines_, line_limits_.noise);
  manhattan_.Update(window_.newest().state.t_ns, directions);
  NameAxes(manhattan_, directions, &lines_);
  if (config_.estimator.manhattan_constraints) problem_options_.R_W_M = manhattan_.R_W_M();
  if (config_.estimator.line_merging) {
    output->counts.line_merging = line_merging_.Merge(window_, &lines_, &manhattan_);
    NoteUse(lines_, &window_);
  }
  output->timings.line_merging = stopwatch.Milliseconds();
}

void Estimator::RemoveOutliers(EstimatorOutput* output) {
  output->counts.points_rejected =
      points_.RemoveOutliers(window_, kMaxReprojectionError_px / focal_length_);
  output->counts.lines_rejected = lines_.RemoveOutliers(window_, line_limits_);
}

void Estimator::Optimize(int max_iterations, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  ProblemBuilder builder(problem_options_, &window_, &prior_);
  builder.AddPrior();
  for (size_t i = 1; i < window_.frames.size(); ++i) builder.AddMotion(i);
  for (auto& [id, landmark] : points_.landmarks()) {
    if (!IsOptimized(landmark)) continue;
    builder.AddPoint(&landmark);
    ++output->counts.points_in_window;
  }
  for (auto& [id, landmark] : lines_.landmarks()) {
    if (!IsOptimized(landmark)) continue;
    builder.AddLine(&landmark);
    ++output->counts.lines_in_window;
  }
  NormalEquations equations(builder.problem());
  SolverOptions options;
  options.max_iterations = max_iterations;
  if (config_.estimator.solver == SolverType::kCeres) {
    SolveByCeres(options, builder.problem());
    equations.Linearize();
  } else {
    Solve(options, builder.problem(), &equations);
  }

  const int64_t newest_ns = window_.newest().state.t_ns;
  const Eigen::MatrixXd covariance =
      equations.Covariance({{BlockKind::kPose, newest_ns}, {BlockKind::kMotion, newest_ns}});
  if (covariance.size() > 0) {
    output->pose_covariance = covariance.topLeftCorner<6, 6>();
    output->velocity_covariance = covariance.block<3, 3>(6, 6);
  }
  output->timings.optimization = stopwatch.Milliseconds();
}

void Estimator::SlideWindow(bool keep_second_newest, EstimatorOutput* output) {
  const Stopwatch stopwatch;
  if (!keep_second_newest) {
    DropSecondNewestFrame();
  } else if (static_cast<int>(window_.frames.size()) > config_.estimator.window_size) {
    MarginalizeOldestFrame(output);
  }
  output->timings.marginalization = stopwatch.Milliseconds();
}

void Estimator::MarginalizeOldestFrame(EstimatorOutput* output) {
  const int64_t oldest_ns = window_.frames.front().state.t_ns;
  const bool stays = StaysAsAnchor(anchor_options_, window_, lines_);
  if (stays) MakeRoomForAnchor();
  prior_ = MarginalizeOldest(problem_options_, prior_, &window_, &points_, &lines_, stays);
  if (config_.estimator.line_merging) line_merging_.Remember(window_, lines_, stays);
  points_.StartAnew(window_, oldest_ns, [&](const PointLandmark& point) {
    output->departed_points.push_back({point.id, PositionInWorld(point, window_)});
  });
  lines_.StartAnew(window_, oldest_ns, [&](const LineLandmark& line) {
    if (const auto segment = DepartingSegment(line)) output->departed_lines.push_back(*segment);
  });
  points_.RemoveFrame(window_, oldest_ns);
  lines_.RemoveFrame(window_, oldest_ns);
  if (stays) {
    window_.TurnOldestIntoAnchor();
  } else {
    window_.RemoveOldest();
  }
}

void Estimator::MakeRoomForAnchor() {
  const auto replaced_ns = AnchorToReplace(anchor_options_, window_);
  if (!replaced_ns) return;
  prior_ = prior_.Marginalize(IsOfFrame(*replaced_ns));
  lines_.RemoveAnchor(*replaced_ns);
  line_merging_.RemoveAnchor(*replaced_ns);
  window_.RemoveAnchor(*replaced_ns);
}

// All that was seen of a line, from its first view on.
std::optional<MapLine> Estimator::DepartingSegment(const LineLandmark& line) const {
  const RememberedLine* known = line_merging_.memory().Find(line.id);
  if (known == nullptr) return ObservedSegment(line, window_);
  return MapLine{line.id, known->seen_W.start_F, known->seen_W.end_F, line.axis};
}

void Estimator::DropSecondNewestFrame() {
  const int64_t dropped_ns = window_.frames[window_.frames.size() - 2].state.t_ns;
  prior_ = prior_.Marginalize(IsOfFrame(dropped_ns));
  points_.RemoveFrame(window_, dropped_ns);
  lines_.RemoveFrame(window_, dropped_ns);
  window_.RemoveSecondNewest();
}

void Estimator::Describe(EstimatorOutput* output) const {
  output->status = EstimatorStatus::kTracking;
  output->has_pose = true;
  output->state = window_.newest().state;
  output->T_B_C = window_.T_B_C();
  output->td = window_.td;
  output->R_W_M = manhattan_.R_W_M();
  output->stationary = window_.newest().stationary;
  for (const WindowFrame& frame : window_.frames) output->window.push_back(frame.state);
  for (const auto& [id, landmark] : points_.landmarks()) {
    if (IsOptimized(landmark)) output->points.push_back({id, PositionInWorld(landmark, window_)});
  }
  for (const auto& [id, landmark] : lines_.landmarks()) {
    if (!IsOptimized(landmark)) continue;
    if (const auto segment = ObservedSegment(landmark, window_)) output->lines.push_back(*segment);
  }
}

}  // namespace plm_vins
