// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/placement_problem.h"

#include <cstddef>
#include <vector>

namespace plm_vins {
namespace {

// Rays are not corrected for intrinsics here: they were computed with almost the current ones.
ProblemOptions WithoutIntrinsics(ProblemOptions options) {
  options.estimate_intrinsics = false;
  return options;
}

// Holds everything fixed except the states of later frames.
WindowVariables::IsConstant KnownUntil(int64_t t_ns) {
  return [t_ns](const BlockId& id) {
    const bool of_frame = id.kind == BlockKind::kPose || id.kind == BlockKind::kMotion;
    return !of_frame || id.key <= t_ns;
  };
}

}  // namespace

PlacementProblem::PlacementProblem(const ProblemOptions& options, LocalMap* map,
                                   int64_t known_until_ns)
    : options_(WithoutIntrinsics(options)),
      known_until_ns_(known_until_ns),
      variables_(&map->window, KnownUntil(known_until_ns), /*first_estimates=*/nullptr, &problem_),
      motion_(&options_, &map->window, &variables_, &problem_),
      observations_(&options_, &map->window, &variables_, &problem_) {
  const std::vector<WindowFrame>& frames = map->window.frames;
  for (size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].state.t_ns > known_until_ns) motion_.Add(i);
  }
  for (auto& [id, landmark] : map->points.landmarks()) AddNewObservations(&landmark);
  for (auto& [id, landmark] : map->lines.landmarks()) AddNewObservations(&landmark);
}

template <typename Landmark>
void PlacementProblem::AddNewObservations(Landmark* landmark) {
  const bool is_known = WasOptimizedAt(known_until_ns_, *landmark);
  if (!is_known || landmark->observations.back().t_ns <= known_until_ns_) return;
  const auto known = observations_.AddConstant(landmark);
  for (const auto& observation : landmark->observations) {
    if (observation.t_ns <= known_until_ns_) continue;
    observations_.AddObservation(known, observation);
    observations_.AddDepth(known, observation);
  }
}

}  // namespace plm_vins
