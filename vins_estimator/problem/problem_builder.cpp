// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_builder.h"

#include "vins_estimator/factors/manhattan_factor.h"
#include "vins_estimator/factors/priors.h"

namespace plm_vins {
namespace {

// Selects the calibration variables that are not estimated; the other ones, if not estimated, are
// not part of the problem.
WindowVariables::IsConstant KnownCalibration(const ProblemOptions& options) {
  const bool knows_extrinsic = !options.estimate_extrinsic, knows_td = !options.estimate_td;
  const bool knows_stream = !options.estimate_depth_stream;
  return [=](const BlockId& id) {
    return (id.kind == BlockKind::kExtrinsic && id.key == 0 && knows_extrinsic) ||
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
      observations_(&options_, window, &variables_, &problem_),
      manhattan_loss_(options.manhattan_loss_scale) {}

void ProblemBuilder::AddAll(PointMap* points, LineMap* lines) {
  AddPrior();
  AddExtrinsicsPriors();
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

void ProblemBuilder::AddExtrinsicsPriors() {
  for (const ExtrinsicsLink& link : options_.extrinsics_links) {
    problem_.AddTerm(ExtrinsicsPrior(link.T_Ci_Cj, link.deviation), nullptr,
                     {variables_.Extrinsics(link.i), variables_.Extrinsics(link.j)});
  }
}

template <typename Landmark>
void ProblemBuilder::AddObservations(const ProblemLandmark<Landmark>& landmark, int64_t until_ns) {
  const auto& observations = landmark.landmark->observations;
  const size_t first_in_newest = FirstInNewest(*landmark.landmark);
  for (size_t i = 0; i < observations.size(); ++i) {
    if (observations[i].t_ns < until_ns || i == first_in_newest) {
      observations_.AddObservation(landmark, observations[i]);
    }
  }
  for (const auto& observation : observations) {
    if (observation.t_ns < until_ns) observations_.AddDepth(landmark, observation);
  }
}

void ProblemBuilder::AddPoint(PointLandmark* landmark, int64_t until_ns) {
  AddObservations(observations_.AddEliminated(landmark), until_ns);
}

void ProblemBuilder::AddLine(LineLandmark* landmark, int64_t until_ns) {
  const ProblemLine line = observations_.AddEliminated(landmark);
  AddObservations(line, until_ns);
  for (const LineLandmark::Observation& observation : landmark->anchor_observations) {
    observations_.AddAnchorObservation(line, observation);
  }
  if (!options_.R_W_M || landmark->axis == LineAxis::kFree) return;
  const Eigen::Vector3d axis_W = *options_.R_W_M * UnitVector(landmark->axis);
  problem_.AddLandmarkTerm(*line.eliminated, ManhattanFactor(axis_W, options_.manhattan_weight),
                           &manhattan_loss_, {line.host_pose, line.host_extrinsics, line.variable});
}

}  // namespace plm_vins
