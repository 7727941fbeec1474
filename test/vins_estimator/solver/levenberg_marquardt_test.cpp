// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/zero_velocity_factor.h"

namespace plm_vins {
namespace {

// A factor whose Jacobian has the wrong sign, so that each step increases the cost.
class Misleading final : public SizedFactor<1, 1> {
 public:
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = parameters[0][0];
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = -1;
    return true;
  }
};

// Five frames with IMU and points; first pose, extrinsics and time offset are constant.
class LevenbergMarquardtTest : public ::testing::Test {
 protected:
  LevenbergMarquardtTest() : simulated_(testing::SimulateWindow(5)), loss_(1.0) {
    auto& frames = simulated_.window.frames;
    SlidingWindow& window = simulated_.window;
    const int extrinsic =
        problem_.AddVariable({BlockKind::kExtrinsic, 0}, window.cameras[0].extrinsics.data(), true);
    const int td = problem_.AddVariable({BlockKind::kTimeOffset, 0}, &window.td, true);
    for (WindowFrame& frame : frames) {
      FrameState& state = frame.state;
      problem_.AddVariable({BlockKind::kPose, state.t_ns}, state.pose.data(), &frame == &frames[0]);
      problem_.AddVariable({BlockKind::kMotion, state.t_ns}, state.motion.data());
    }
    for (size_t i = 1; i < frames.size(); ++i) {
      problem_.AddTerm(ImuFactor(frames[i].motion_since_previous.get(), window.gravity_W), nullptr,
                       {Pose(i - 1), Motion(i - 1), Pose(i), Motion(i)});
    }
    for (auto& [id, landmark] : simulated_.points.landmarks()) {
      if (landmark.triangulated) AddPoint(extrinsic, td, &landmark);
    }
    equations_.emplace(problem_);
    thorough_.max_iterations = 100;
    thorough_.deviation_tolerance = 1e-6;
    thorough_.step_tolerance = 1e-12;
  }

  int Pose(size_t i) const { return 2 + 2 * static_cast<int>(i); }
  int Motion(size_t i) const { return Pose(i) + 1; }
  int PoseAt(int64_t t_ns) const { return problem_.Find({BlockKind::kPose, t_ns}); }

  void AddPoint(int extrinsic, int td, PointLandmark* landmark) {
    constexpr double kWeight = 460 / 0.5;
    const BlockId id{BlockKind::kPoint, landmark->id};
    const int index = problem_.AddLandmark(id, landmark->coordinates.data());
    const int point = problem_.Find(id);
    const PointLandmark::Observation& host = landmark->host();
    const ChainKind of_host{/*same_frame=*/true, /*same_camera=*/true};
    problem_.AddLandmarkTerm(index, PointFactor(of_host, host.bearing, kWeight), &loss_,
                             {td, point});
    const ChainKind of_other{/*same_frame=*/false, /*same_camera=*/true};
    for (size_t i = 1; i < landmark->observations.size(); ++i) {
      const PointLandmark::Observation& other = landmark->observations[i];
      problem_.AddLandmarkTerm(index, PointFactor(of_other, other.bearing, kWeight), &loss_,
                               {extrinsic, PoseAt(host.t_ns), PoseAt(other.t_ns), td, point});
    }
  }

  // Disturbs all states except the first pose, and the depths.
  void Disturb(double scale, uint64_t seed) {
    simulator::Random random(seed);
    const auto first_pose = simulated_.window.frames.front().state.pose;
    testing::Disturb(scale, &random, &simulated_.window);
    simulated_.window.frames.front().state.pose = first_pose;
    for (auto& [id, landmark] : simulated_.points.landmarks()) {
      landmark.coordinates[2] *= std::exp(scale * random.Normal());
    }
  }

  testing::SimulatedWindow simulated_;
  ceres::CauchyLoss loss_;
  WindowProblem problem_;
  std::optional<NormalEquations> equations_;
  SolverOptions thorough_;
};

TEST_F(LevenbergMarquardtTest, FewDefaultIterationsAreEnoughFromAPrediction) {
  const double lowest = Solve(thorough_, problem_, &*equations_).final_cost;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Disturb(0.003, seed);
    const double cost = Solve(SolverOptions(), problem_, &*equations_).final_cost;
    // The error of the last prediction approximates the remaining gain, which may be slightly
    // larger.
    EXPECT_LT(cost - lowest, 2 * LeastGain(SolverOptions(), problem_)) << seed;
  }
}

// No second step is needed to find that there is nothing left to gain.
TEST_F(LevenbergMarquardtTest, StopsAfterAStepWithThePredictedGain) {
  const double lowest = Solve(thorough_, problem_, &*equations_).final_cost;
  Disturb(0.0002, 1);
  const SolverSummary summary = Solve(SolverOptions(), problem_, &*equations_);
  EXPECT_GT(summary.initial_cost - summary.final_cost, LeastGain(SolverOptions(), problem_))
      << "a gain that alone would not end it";
  EXPECT_LT(summary.final_cost, 1.01 * lowest);
  EXPECT_EQ(summary.iterations, 1);
}

// A prior adds an unknown constant to the cost.
TEST_F(LevenbergMarquardtTest, StoppingDoesNotDependOnAConstantCost) {
  const std::vector<double> truth = testing::CopyValues(problem_);
  Disturb(0.01, 1);
  const SolverSummary expected = Solve(SolverOptions(), problem_, &*equations_);
  ASSERT_GT(expected.iterations, 1);

  testing::RestoreValues(truth, problem_);
  double constant = 1e4;
  const int index = problem_.AddVariable({BlockKind::kTimeOffset, 1}, &constant, true);
  problem_.AddTerm(Misleading(), nullptr, {index});
  Disturb(0.01, 1);
  equations_.emplace(problem_);
  const SolverSummary summary = Solve(SolverOptions(), problem_, &*equations_);
  EXPECT_EQ(summary.iterations, expected.iterations);
  EXPECT_NEAR(summary.final_cost - 0.5 * constant * constant, expected.final_cost, 1e-3);
}

TEST_F(LevenbergMarquardtTest, NeverEndsAboveTheInitialCost) {
  const std::vector<double> truth = testing::CopyValues(problem_);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    testing::RestoreValues(truth, problem_);
    Disturb(0.02 * static_cast<double>(seed), seed);  // up to 0.4 m, 0.4 rad, a depth of 1.5
    for (const int iterations : {1, 2, 8}) {
      SolverOptions options;
      options.max_iterations = iterations;
      const SolverSummary summary = Solve(options, problem_, &*equations_);
      EXPECT_LE(summary.final_cost, summary.initial_cost) << seed;
      EXPECT_LE(summary.iterations, iterations);
      EXPECT_NEAR(equations_->Cost() / summary.final_cost, 1, 1e-12) << "values and cost differ";
    }
  }
}

TEST_F(LevenbergMarquardtTest, ReachesTheMinimumFromABadStart) {
  const SolverSummary from_truth = Solve(thorough_, problem_, &*equations_);
  Disturb(0.1, 3);
  const SolverSummary summary = Solve(thorough_, problem_, &*equations_);
  EXPECT_GT(summary.initial_cost, 10 * from_truth.final_cost);
  // The robust loss may leave a point or two in local minima.
  EXPECT_LT(summary.final_cost, 1.02 * from_truth.final_cost);
}

TEST_F(LevenbergMarquardtTest, RejectsValuesThatAreNotFinite) {
  simulated_.window.frames[2].state.velocity().x() = std::numeric_limits<double>::quiet_NaN();
  const auto pose = simulated_.window.newest().state.pose;
  EXPECT_FALSE(Solve(SolverOptions(), problem_, &*equations_).solved);
  EXPECT_EQ(simulated_.window.newest().state.pose, pose);
}

TEST(LevenbergMarquardt, ConvergesWithoutAnyGain) {
  WindowProblem problem;
  double value = 2;
  const int index = problem.AddVariable({BlockKind::kTimeOffset, 0}, &value);
  problem.AddTerm(Misleading(), nullptr, {index});
  NormalEquations equations(problem);
  const SolverSummary summary = Solve(SolverOptions(), problem, &equations);
  EXPECT_TRUE(summary.solved);
  EXPECT_EQ(summary.final_cost, 2.0);
  EXPECT_EQ(value, 2);
}

// Only the sum of the two variables is observable, so the equations need damping.
class Sum final : public SizedFactor<1, 1, 1> {
 public:
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = parameters[0][0] + parameters[1][0];
    for (int i = 0; i < 2; ++i) {
      if (jacobians != nullptr && jacobians[i] != nullptr) jacobians[i][0] = 1;
    }
    return true;
  }
};

TEST(LevenbergMarquardt, CountsNoIterationIfSingular) {
  WindowProblem problem;
  std::array<double, 2> values = {1, 2};
  const int first = problem.AddVariable({BlockKind::kTimeOffset, 0}, &values[0]);
  const int second = problem.AddVariable({BlockKind::kTimeOffset, 1}, &values[1]);
  problem.AddTerm(Sum(), nullptr, {first, second});
  NormalEquations equations(problem);
  SolverOptions options;
  options.max_iterations = 1;
  const SolverSummary summary = Solve(options, problem, &equations);
  EXPECT_TRUE(summary.solved);
  EXPECT_EQ(summary.iterations, 1);
  EXPECT_NEAR(values[0] + values[1], 0, 1e-3);
}

TEST(LevenbergMarquardt, DoesNotChangeASingularProblem) {
  WindowProblem problem;
  std::array<double, 9> motion = {1, 2, 3, 4, 5, 6, 7, 8, 9};  // the biases are unobservable
  const int index = problem.AddVariable({BlockKind::kMotion, 1}, motion.data());
  problem.AddTerm(ZeroVelocityFactor(1.0), nullptr, {index});
  NormalEquations equations(problem);
  const SolverSummary summary = Solve(SolverOptions(), problem, &equations);
  EXPECT_FALSE(summary.solved);
  EXPECT_EQ(summary.final_cost, 7.0);
  EXPECT_EQ(motion, (std::array<double, 9>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

}  // namespace
}  // namespace plm_vins
