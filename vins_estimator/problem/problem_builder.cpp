// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_builder.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/intrinsics_factor.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/manhattan_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/readout_factor.h"
#include "vins_estimator/factors/zero_velocity_factor.h"
#include "vins_estimator/problem/expected_rays.h"

namespace plm_vins {
namespace {

// What an anchor has seen of a line that comes back is part of the prior already, and the line may
// be another one that looks the same; so it counts less.
constexpr double kAnchorNoise = 5.0;  // in units of the noise of lines

}  // namespace

ProblemOptions::ProblemOptions(const Config& config, double focal_length)
    : manhattan_weight(180 / (M_PI * config.estimator.manhattan_noise)),
      estimate_extrinsic(config.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kFixed),
      estimate_td(config.sensor.estimate_td),
      estimate_readout(config.sensor.estimate_rolling_shutter_tr),
      estimate_intrinsics(config.sensor.estimate_intrinsics),
      camera(config.sensor.camera) {
  SetNoise(config.estimator.point_noise / focal_length, config.estimator.line_noise / focal_length);
}

void ProblemOptions::SetNoise(double point_noise, double line_noise) {
  point_weight = 1 / point_noise;
  line_weight = 1 / line_noise;
  anchor_weight = line_weight / kAnchorNoise;
}

void ProblemOptions::LetPass(double flow, std::optional<double> depth) {
  if (!depth) return;
  passing_velocity = flow * *depth;
  passing_turn_rate = flow;
}

ProblemBuilder::ProblemBuilder(const ProblemOptions& options, SlidingWindow* window,
                               const MarginalizationPrior* prior)
    : options_(options),
      window_(window),
      prior_(prior),
      camera_(options.estimate_intrinsics
                  ? CameraModel::Create(options.camera.With(window->ray_intrinsics))
                  : nullptr),
      point_loss_(options.point_loss_scale),
      line_loss_(options.line_loss_scale),
      manhattan_loss_(options.manhattan_loss_scale) {}

double* ProblemBuilder::Values(const BlockId& id) {
  switch (id.kind) {
    case BlockKind::kExtrinsic:
      return window_->extrinsic.data();
    case BlockKind::kTimeOffset:
      return &window_->td;
    case BlockKind::kReadout:
      return &window_->readout;
    case BlockKind::kIntrinsics:
      return window_->intrinsics.data();
    case BlockKind::kPose:
      return window_->StateAt(id.key).pose.data();
    case BlockKind::kMotion:
      return window_->FrameAt(id.key).state.motion.data();
    default:
      throw std::logic_error("landmarks are added with their terms");
  }
}

bool ProblemBuilder::IsConstant(const BlockId& id) const {
  if (constants_until_ns_) {
    const bool of_frame = id.kind == BlockKind::kPose || id.kind == BlockKind::kMotion;
    return !of_frame || id.key <= *constants_until_ns_;
  }
  return (id.kind == BlockKind::kExtrinsic && !options_.estimate_extrinsic) ||
         (id.kind == BlockKind::kTimeOffset && !options_.estimate_td);
}

int ProblemBuilder::AddVariable(const BlockId& id) {
  const int known = problem_.Find(id);
  if (known >= 0) return known;
  const bool at_first_estimates = options_.jacobians_at == JacobiansAt::kFirstEstimates;
  return problem_.AddVariable(id, Values(id), IsConstant(id),
                              at_first_estimates ? prior_->Linearization(id) : nullptr);
}

void ProblemBuilder::AddAll(PointMap* points, LineMap* lines) {
  AddPrior();
  for (size_t i = 1; i < window_->frames.size(); ++i) AddMotion(i);
  for (auto& [id, landmark] : points->landmarks()) {
    if (IsOptimized(landmark)) AddPoint(&landmark);
  }
  for (auto& [id, landmark] : lines->landmarks()) {
    if (IsOptimized(landmark)) AddLine(&landmark);
  }
}

void ProblemBuilder::AddStatesAfter(int64_t t_ns, PointMap* points, LineMap* lines) {
  constants_until_ns_ = t_ns;
  for (size_t i = 1; i < window_->frames.size(); ++i) {
    if (window_->frames[i].state.t_ns > t_ns) AddMotion(i);
  }
  const auto holds_states = [t_ns](const auto& landmark) {
    return WasOptimizedAt(t_ns, landmark) && landmark.views.back().t_ns > t_ns;
  };
  for (auto& [id, landmark] : points->landmarks()) {
    if (holds_states(landmark)) AddViewsOfKnown(&landmark);
  }
  for (auto& [id, landmark] : lines->landmarks()) {
    if (holds_states(landmark)) AddViewsOfKnown(&landmark);
  }
}

void ProblemBuilder::AddPrior() {
  for (const MarginalizationPrior::Block& block : prior_->blocks()) AddVariable(block.id);
  problem_.SetPrior(prior_);
}

void ProblemBuilder::AddMotion(size_t index) {
  const WindowFrame& from = window_->frames[index - 1];
  const WindowFrame& to = window_->frames[index];
  const int pose_i = Pose(from.state.t_ns), motion_i = Motion(from.state.t_ns);
  const int pose_j = Pose(to.state.t_ns), motion_j = Motion(to.state.t_ns);
  problem_.AddTerm(ImuFactor(to.motion_since_previous.get(), window_->gravity_W), nullptr,
                   {pose_i, motion_i, pose_j, motion_j});
  if (!to.stationary) return;
  const double interval = ToSeconds(to.state.t_ns - from.state.t_ns);
  const double velocity = std::max(options_.standstill_velocity, options_.passing_velocity);
  const double position =
      std::max(options_.standstill_position, options_.passing_velocity * interval);
  const double rotation =
      std::max(options_.standstill_rotation, options_.passing_turn_rate * interval);
  problem_.AddTerm(ZeroVelocityFactor(velocity), nullptr, {motion_j});
  problem_.AddTerm(SamePoseFactor(position, rotation), nullptr, {pose_i, pose_j});
}

template <typename FactorType, int kCount>
void ProblemBuilder::AddTerm(int index, const FactorType& factor, const ceres::LossFunction* loss,
                             const int (&variables)[kCount]) {
  if (index == kNotEliminated) {
    problem_.AddTerm(factor, loss, variables);
  } else {
    problem_.AddLandmarkTerm(index, factor, loss, variables);
  }
}

template <typename ViewFactor, typename... Indices>
void ProblemBuilder::AddPointTerm(int index, const PointLandmark& landmark, const PointView& view,
                                  Indices... variables) {
  const ViewFactor factor(view.bearing, options_.point_weight);
  if (!options_.estimate_readout) {
    AddPointFactor(index, factor, landmark, view, variables...);
    return;
  }
  const int readout = AddVariable({BlockKind::kReadout, 0});
  AddPointFactor(index, ReadoutFactor<ViewFactor>(factor, view.bearing), landmark, view,
                 variables..., readout);
}

template <typename ViewFactor, typename... Indices>
void ProblemBuilder::AddPointFactor(int index, const ViewFactor& factor,
                                    const PointLandmark& landmark, const PointView& view,
                                    Indices... variables) {
  if (!camera_) {
    AddTerm(index, factor, &point_loss_, {variables...});
    return;
  }
  const RayShift shift(*camera_, ExpectedRay(landmark, view, *window_));
  AddTerm(index, PointIntrinsicsFactor<ViewFactor>(factor, shift, options_.point_weight),
          &point_loss_, {variables..., AddVariable({BlockKind::kIntrinsics, 0})});
}

template <typename ViewFactor, typename... Indices>
void ProblemBuilder::AddLineTerm(int index, const LineLandmark& landmark, const LineView& view,
                                 double weight, Indices... variables) {
  if (!camera_) {
    AddTerm(index, ViewFactor(view.segment, weight), &line_loss_, {variables...});
    return;
  }
  const LineSegmentView expected = ExpectedEnds(landmark, view, *window_);
  AddTerm(index,
          LineIntrinsicsFactor<ViewFactor>(view.segment, weight, RayShift(*camera_, expected.start),
                                           RayShift(*camera_, expected.end)),
          &line_loss_, {variables..., AddVariable({BlockKind::kIntrinsics, 0})});
}

void ProblemBuilder::AddPoint(PointLandmark* landmark) {
  const BlockId id{BlockKind::kPoint, landmark->id};
  const int index = problem_.AddLandmark(id, landmark->coordinates.data());
  const int point = problem_.Find(id);
  const int extrinsic = AddVariable({BlockKind::kExtrinsic, 0});
  const int td = AddVariable({BlockKind::kTimeOffset, 0});
  const PointView& host = landmark->host();
  const int host_pose = Pose(host.t_ns);
  problem_.ReserveLandmarkTerms(index, landmark->views.size());
  AddPointTerm<PointHostFactor>(index, *landmark, host, td, point);
  for (size_t i = 1; i < landmark->views.size(); ++i) {
    const PointView& view = landmark->views[i];
    AddPointTerm<PointFactor>(index, *landmark, view, host_pose, Pose(view.t_ns), extrinsic, td,
                              point);
  }
}

void ProblemBuilder::AddViewsOfKnown(PointLandmark* landmark) {
  const int point = problem_.AddVariable({BlockKind::kPoint, landmark->id},
                                         landmark->coordinates.data(), /*constant=*/true);
  const int host_pose = Pose(landmark->host().t_ns);
  const int extrinsic = AddVariable({BlockKind::kExtrinsic, 0});
  const int td = AddVariable({BlockKind::kTimeOffset, 0});
  for (const PointView& view : landmark->views) {
    if (view.t_ns <= *constants_until_ns_) continue;
    AddPointTerm<PointFactor>(kNotEliminated, *landmark, view, host_pose, Pose(view.t_ns),
                              extrinsic, td, point);
  }
}

void ProblemBuilder::AddLine(LineLandmark* landmark) {
  const BlockId id{BlockKind::kLine, landmark->id};
  const int index = problem_.AddLandmark(id, landmark->coordinates.data());
  const int line = problem_.Find(id);
  const int extrinsic = AddVariable({BlockKind::kExtrinsic, 0});
  const LineView& host = landmark->host();
  const int host_pose = Pose(host.t_ns);
  problem_.ReserveLandmarkTerms(index, landmark->views.size() + landmark->anchor_views.size() + 1);
  AddLineTerm<LineHostFactor>(index, *landmark, host, options_.line_weight, line);
  const auto add_view = [&](const LineView& view, double weight) {
    AddLineTerm<LineFactor>(index, *landmark, view, weight, host_pose, Pose(view.t_ns), extrinsic,
                            line);
  };
  for (size_t i = 1; i < landmark->views.size(); ++i) {
    add_view(landmark->views[i], options_.line_weight);
  }
  for (const LineView& view : landmark->anchor_views) add_view(view, options_.anchor_weight);
  if (!options_.R_W_M || landmark->axis == LineAxis::kFree) return;
  const Eigen::Vector3d axis_W = *options_.R_W_M * UnitVector(landmark->axis);
  problem_.AddLandmarkTerm(index, ManhattanFactor(axis_W, options_.manhattan_weight),
                           &manhattan_loss_, {host_pose, extrinsic, line});
}

void ProblemBuilder::AddViewsOfKnown(LineLandmark* landmark) {
  const int line = problem_.AddVariable({BlockKind::kLine, landmark->id},
                                        landmark->coordinates.data(), /*constant=*/true);
  const int host_pose = Pose(landmark->host().t_ns);
  const int extrinsic = AddVariable({BlockKind::kExtrinsic, 0});
  for (const LineView& view : landmark->views) {
    if (view.t_ns <= *constants_until_ns_) continue;
    AddLineTerm<LineFactor>(kNotEliminated, *landmark, view, options_.line_weight, host_pose,
                            Pose(view.t_ns), extrinsic, line);
  }
}

}  // namespace plm_vins
