// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_builder.h"

#include "vins_estimator/factors/manhattan_factor.h"

namespace plm_vins {
namespace {

// Selects the calibration variables that are not estimated; the other ones, if not estimated, are
// not part of the problem.
WindowVariables::IsConstant KnownCalibration(const ProblemOptions& options) {
  const bool knows_extrinsic = !options.estimate_extrinsic, knows_td = !options.estimate_td;
  const bool knows_mounting = !options.estimate_mounting;
  const bool knows_stream = !options.estimate_depth_stream;
  return [=](const BlockId& id) {
    return (id.kind == BlockKind::kExtrinsic && knows_extrinsic) ||
           (id.kind == BlockKind::kMounting && knows_mounting) ||
           (id.kind == BlockKind::kDepthStream && knows_stream) ||
           (id.kind == BlockKind::kTimeOffset && knows_td);
  };
}

}  // namespace

ProblemBuilder::ProblemBuilder(const ProblemOptions& options, SlidingWindow* window,
                               const MarginalizationPrior* prior)
    : options_(options),
      window_(window),
      prior_(prior),
      variables_(window, KnownCalibration(options),
                 options.jacobians_at == JacobiansAt::kFirstEstimates ? prior : nullptr, &problem_),
      motion_(&options_, window, &variables_, &problem_),
      views_(&options_, window, &variables_, &problem_),
      manhattan_loss_(options.manhattan_loss_scale) {}

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

void ProblemBuilder::AddPrior() {
  for (const MarginalizationPrior::Block& block : prior_->blocks()) variables_.Add(block.id);
  problem_.SetPrior(prior_);
}

template <typename ProblemLandmark>
void ProblemBuilder::AddViews(const ProblemLandmark& landmark, int64_t depth_until_ns) {
  const auto& views = landmark.landmark->views;
  views_.AddHostView(landmark);
  for (size_t i = 1; i < views.size(); ++i) views_.AddView(landmark, views[i]);
  for (const auto& view : views) {
    if (view.t_ns < depth_until_ns) views_.AddDepth(landmark, view);
  }
}

void ProblemBuilder::AddPoint(PointLandmark* landmark, int64_t depth_until_ns) {
  AddViews(views_.AddEliminated(landmark), depth_until_ns);
}

void ProblemBuilder::AddLine(LineLandmark* landmark, int64_t depth_until_ns) {
  const ProblemLine line = views_.AddEliminated(landmark);
  AddViews(line, depth_until_ns);
  for (const LineView& view : landmark->anchor_views) views_.AddAnchorView(line, view);
  if (!options_.R_W_M || landmark->axis == LineAxis::kFree) return;
  const Eigen::Vector3d axis_W = *options_.R_W_M * UnitVector(landmark->axis);
  problem_.AddLandmarkTerm(*line.eliminated, ManhattanFactor(axis_W, options_.manhattan_weight),
                           &manhattan_loss_, {line.host_pose, line.extrinsic, line.line});
}

}  // namespace plm_vins
