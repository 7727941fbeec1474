// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/placement_problem.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/geometry/so3.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/solver/levenberg_marquardt.h"

namespace plm_vins {
namespace {

int64_t Stamp(const testing::SimulatedWindow& simulated, size_t frame) {
  return simulated.window.frames[frame].state.t_ns;
}

// All optional variables are estimated.
TEST(PlacementProblem, TheStatesAfterAFrameAloneAreFree) {
  ProblemOptions options = testing::OnePixelOptions();
  options.estimate_extrinsic = options.estimate_td = true;
  options.estimate_intrinsics = true;
  testing::SimulatedWindow simulated = testing::SimulateWindow(4);
  for (const size_t last_known : {1, 2}) {
    const int64_t known_ns = Stamp(simulated, last_known);
    const PlacementProblem placement(options, &simulated, known_ns);
    const WindowProblem& problem = placement.problem();
    EXPECT_TRUE(problem.landmarks().empty());
    for (const Variable& variable : problem.variables()) {
      const bool of_frame =
          variable.id.kind == BlockKind::kPose || variable.id.kind == BlockKind::kMotion;
      EXPECT_EQ(variable.constant, !of_frame || variable.id.key <= known_ns);
    }
    // Counts the IMU terms, and the observations of each landmark observed by at least two known
    // frames.
    size_t seen = 0;
    const auto count = [&](const auto& landmarks) {
      for (const auto& [id, landmark] : landmarks) {
        if (!IsOptimized(landmark) || landmark.observations[1].t_ns > known_ns) continue;
        seen += std::count_if(landmark.observations.begin(), landmark.observations.end(),
                              [&](const auto& view) { return view.t_ns > known_ns; });
      }
    };
    count(simulated.points.landmarks());
    count(simulated.lines.landmarks());
    EXPECT_GT(seen, 20u);
    EXPECT_EQ(problem.terms().size(), 3 - last_known + seen);
  }
}

TEST(PlacementProblem, FindsStatesGivenTheRest) {
  const testing::SimulatedWindow simulated = testing::SimulateWindow(4);
  for (const size_t last_known : {1, 2}) {
    testing::SimulatedWindow moved = simulated;
    for (size_t i = last_known + 1; i < 4; ++i) {
      FrameState& state = moved.window.frames[i].state;
      state.SetPose({state.rotation() * SO3Exp({0.01, -0.02, 0.01}),
                     state.position() + Eigen::Vector3d(0.05, -0.03, 0.04)});
    }
    const PlacementProblem placement(testing::OnePixelOptions(), &moved,
                                     Stamp(simulated, last_known));
    NormalEquations equations(placement.problem());
    EXPECT_TRUE(Solve(SolverOptions(), placement.problem(), &equations).solved);
    for (size_t i = 0; i < 4; ++i) {
      const FrameState& found = moved.window.frames[i].state;
      const FrameState& truth = simulated.window.frames[i].state;
      EXPECT_LT((found.position() - truth.position()).norm(), 0.005);
      EXPECT_LT(found.rotation().angularDistance(truth.rotation()), 0.002);
    }
  }
}

}  // namespace
}  // namespace plm_vins
