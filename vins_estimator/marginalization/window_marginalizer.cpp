// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_marginalizer.h"

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/problem/problem_builder.h"

namespace plm_vins {
namespace {

// Eliminates the landmarks of a problem and returns a prior on its frame variables.
MarginalizationPrior Summarize(const WindowProblem& problem) {
  NormalEquations equations(problem);
  equations.Linearize();
  Quadratic quadratic;
  equations.Reduce(0, &quadratic.H, &quadratic.b);
  quadratic.H.triangularView<Eigen::StrictlyLower>() = quadratic.H.transpose();

  std::vector<MarginalizationPrior::Block> blocks;
  Eigen::VectorXd delta(quadratic.b.size());
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const Variable& variable = problem.variables()[i];
    const int offset = equations.DenseOffset(static_cast<int>(i));
    if (offset < 0) continue;
    const double* x0 = variable.linearization ? variable.linearization : variable.values;
    blocks.push_back(MarginalizationPrior::MakeBlock(variable.id, offset, x0));
    variable.type().minus(variable.values, x0, &delta[offset]);
  }
  // The equations' b is the gradient at the current values; the prior's b refers to the
  // linearization points.
  quadratic.b -= quadratic.H * delta;
  return {std::move(blocks), std::move(quadratic)};
}

// Returns a predicate that selects the velocity and biases of one frame.
std::function<bool(const BlockId&)> IsMotionOfFrame(int64_t t_ns) {
  return [t_ns](const BlockId& id) { return id.kind == BlockKind::kMotion && id.key == t_ns; };
}

}  // namespace

std::function<bool(const BlockId&)> IsOfFrame(int64_t t_ns) {
  return [t_ns](const BlockId& id) {
    return (id.kind == BlockKind::kPose || id.kind == BlockKind::kMotion) && id.key == t_ns;
  };
}

MarginalizationPrior MarginalizeOldest(const ProblemOptions& options,
                                       const MarginalizationPrior& prior, LocalMap* map,
                                       bool keep_pose) {
  const int64_t oldest_ns = map->window.frames.front().state.t_ns;
  const int64_t newest_ns = map->window.newest().state.t_ns;
  ProblemBuilder builder(options, &map->window, &prior);
  builder.AddPrior();
  builder.AddMotion(1);
  for (auto& [id, landmark] : map->points.landmarks()) {
    if (LeavesWith(oldest_ns, landmark)) builder.AddPoint(&landmark, newest_ns);
  }
  for (auto& [id, landmark] : map->lines.landmarks()) {
    if (LeavesWith(oldest_ns, landmark)) builder.AddLine(&landmark, newest_ns);
  }
  return Summarize(builder.problem())
      .Marginalize(keep_pose ? IsMotionOfFrame(oldest_ns) : IsOfFrame(oldest_ns));
}

}  // namespace plm_vins
