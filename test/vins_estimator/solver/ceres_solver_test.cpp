// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/manhattan/line_directions.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

// A window with points, lines on Manhattan axes, and the prior of a marginalized frame.
class CeresSolverTest : public ::testing::Test {
 protected:
  CeresSolverTest()
      : estimate_(testing::SimulateWindow(7, /*seed=*/1, /*stride=*/5, /*max_points=*/60)),
        random_(1) {
    options_.estimate_extrinsic = options_.estimate_td = options_.estimate_intrinsics = true;
    options_.R_W_M = Eigen::Quaterniond::Identity();
    NameAxes();
    estimate_.prior = InitialPrior(InitialUncertainty(), options_, estimate_.map.window);
    Disturb(0.001);
    estimate_.SlideOldest(options_, /*stays_as_anchor=*/false);
    options_.jacobians_at = JacobiansAt::kValues;
    Build();
    thorough_.max_iterations = 200;
    thorough_.deviation_tolerance = 1e-7;
    thorough_.step_tolerance = 1e-13;
  }

  void NameAxes() {
    for (const LineDirection& line : LineDirections(estimate_.map.window, estimate_.map.lines,
                                                    1 / testing::kSimulatedFocalLength)) {
      for (const LineAxis axis : {LineAxis::kX, LineAxis::kY, LineAxis::kZ}) {
        const double cosine = std::abs(line.direction_W.dot(UnitVector(axis)));
        if (cosine > 0.999) estimate_.map.lines.landmarks().at(line.id).axis = axis;
      }
    }
  }

  void Build() {
    builder_.emplace(options_, &estimate_.map.window, &estimate_.prior);
    testing::AddAll(&estimate_.map, &*builder_);
  }

  void Disturb(double scale) { testing::Disturb(scale, &random_, &estimate_.map.window); }

  const WindowProblem& problem() const { return builder_->problem(); }

  SolverSummary SolveByOurs(const SolverOptions& options) const {
    NormalEquations equations(problem());
    return Solve(options, problem(), &equations);
  }

  WindowEstimate estimate_;
  simulator::Random random_;
  ProblemOptions options_ = testing::OnePixelOptions();
  std::optional<ProblemBuilder> builder_;
  SolverOptions thorough_;
};

TEST_F(CeresSolverTest, WindowHasAllKindsOfTerms) {
  std::map<BlockKind, int> landmarks;
  for (const LandmarkTerms& landmark : problem().landmarks()) {
    ++landmarks[problem().variables()[landmark.variable].id.kind];
  }
  EXPECT_GT(landmarks[BlockKind::kPoint], 30);
  EXPECT_GT(landmarks[BlockKind::kLine], 5);
  const bool on_axis =
      std::any_of(estimate_.map.lines.landmarks().begin(), estimate_.map.lines.landmarks().end(),
                  [](const auto& line) {
                    return line.second.triangulated && line.second.axis != LineAxis::kFree;
                  });
  EXPECT_TRUE(on_axis);
  EXPECT_GT(estimate_.prior.quadratic().b.norm(), 0);
}

TEST_F(CeresSolverTest, ReachesTheMinimumOfOurSolver) {
  for (int start = 0; start < 3; ++start) {
    Disturb(0.003);
    const std::vector<double> values = testing::CopyValues(problem());
    const SolverSummary ours = SolveByOurs(thorough_);
    const std::vector<WindowFrame> expected(estimate_.map.window.frames.begin(),
                                            estimate_.map.window.frames.end());
    testing::RestoreValues(values, problem());
    const SolverSummary ceres = SolveByCeres(thorough_, problem());
    ASSERT_TRUE(ours.solved && ceres.solved);
    EXPECT_NEAR(ceres.initial_cost / ours.initial_cost, 1, 1e-9);
    EXPECT_NEAR(ceres.final_cost / ours.final_cost, 1, 1e-6);
    for (size_t i = 0; i < expected.size(); ++i) {
      const FrameState& state = estimate_.map.window.frames[i].state;
      EXPECT_MATRIX_NEAR(state.position(), expected[i].state.position(), 1e-6);
      EXPECT_LT(state.rotation().angularDistance(expected[i].state.rotation()), 1e-6);
      EXPECT_MATRIX_NEAR(state.velocity(), expected[i].state.velocity(), 1e-5);
    }
  }
}

TEST_F(CeresSolverTest, SparseEquationsGiveTheSameSolution) {
  Disturb(0.003);
  const std::vector<double> values = testing::CopyValues(problem());
  const SolverSummary dense = SolveByCeres(thorough_, problem());
  const std::vector<WindowFrame> expected(estimate_.map.window.frames.begin(),
                                          estimate_.map.window.frames.end());
  testing::RestoreValues(values, problem());
  const SolverSummary sparse = SolveByCeres(thorough_, problem(), CeresEquations::kSparse);
  ASSERT_TRUE(dense.solved && sparse.solved);
  EXPECT_NEAR(sparse.final_cost / dense.final_cost, 1, 1e-9);
  for (size_t i = 0; i < expected.size(); ++i) {
    const FrameState& state = estimate_.map.window.frames[i].state;
    EXPECT_MATRIX_NEAR(state.position(), expected[i].state.position(), 1e-7);
  }
}

TEST_F(CeresSolverTest, IsBoundedByIterations) {
  Disturb(0.01);
  SolverOptions options;
  options.max_iterations = 2;
  const SolverSummary summary = SolveByCeres(options, problem());
  EXPECT_LE(summary.iterations, 2);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_NEAR(NormalEquations(problem()).Cost() / summary.final_cost, 1, 1e-9);
}

// Ceres orders the eliminated variables by address.
TEST_F(CeresSolverTest, ResultDoesNotDependOnMemoryAddresses) {
  Disturb(0.01);
  Build();
  const std::vector<double> start = testing::CopyValues(problem());
  SolveByCeres(SolverOptions(), problem());
  const std::vector<double> expected = testing::CopyValues(problem());

  testing::RestoreValues(start, problem());
  auto& landmarks = estimate_.map.points.landmarks();
  std::remove_reference_t<decltype(landmarks)> moved;
  for (auto it = landmarks.rbegin(); it != landmarks.rend(); ++it) moved.insert(*it);
  landmarks.swap(moved);
  Build();
  SolveByCeres(SolverOptions(), problem());
  EXPECT_EQ(testing::CopyValues(problem()), expected);
}

TEST_F(CeresSolverTest, DoesNotMoveConstants) {
  options_.estimate_extrinsic = options_.estimate_td = false;
  Build();
  Disturb(0.003);
  const auto extrinsic = estimate_.map.window.cameras[0].extrinsics;
  const double td = estimate_.map.window.td;
  EXPECT_TRUE(SolveByCeres(SolverOptions(), problem()).solved);
  EXPECT_EQ(estimate_.map.window.cameras[0].extrinsics, extrinsic);
  EXPECT_EQ(estimate_.map.window.td, td);
}

TEST_F(CeresSolverTest, IgnoresTermsThatCannotBeEvaluated) {
  const double lowest = SolveByCeres(thorough_, problem()).final_cost;
  const Variable& point = problem().variables()[problem().landmarks()[0].variable];
  ASSERT_EQ(point.id.kind, BlockKind::kPoint);
  point.values[2] = -point.values[2];  // behind every camera
  const SolverSummary summary = SolveByCeres(thorough_, problem());
  EXPECT_TRUE(summary.solved);
  EXPECT_LT(summary.final_cost, lowest);
}

TEST_F(CeresSolverTest, RejectsValuesThatAreNotFinite) {
  estimate_.map.window.frames[2].state.velocity().x() = std::numeric_limits<double>::quiet_NaN();
  const auto pose = estimate_.map.window.newest().state.pose;
  EXPECT_FALSE(SolveByCeres(SolverOptions(), problem()).solved);
  EXPECT_EQ(estimate_.map.window.newest().state.pose, pose);
}

}  // namespace
}  // namespace plm_vins
