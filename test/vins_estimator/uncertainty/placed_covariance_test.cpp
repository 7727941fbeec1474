// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/uncertainty/placed_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/equations/dense_equations.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/bridging/uncertain_state.h"
#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/problem/placement_problem.h"

namespace plm_vins {
namespace {

// Standard deviations of a state in flight, 2 cm for its position.
Vector15d StandardDeviations() {
  Vector15d deviations;
  deviations << 0.02, 0.02, 0.02, 0.01, 0.01, 0.01, 0.03, 0.03, 0.03, 0.02, 0.02, 0.02, 1e-3, 1e-3,
      1e-3;
  return deviations;
}

// A covariance with correlations.
Matrix15d SomeCovariance() {
  simulator::Random random(4);
  Matrix15d root = Matrix15d::Identity();
  for (int i = 0; i < root.size(); ++i) root.data()[i] += 0.3 * random.Normal();
  root = StandardDeviations().asDiagonal() * root;
  return root * root.transpose();
}

// Scales the covariance to units suited to each entry.
Matrix15d Scaled(const Matrix15d& covariance) {
  const Vector15d scale = StandardDeviations().cwiseInverse();
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

Matrix15d Placed(const ProblemOptions& options, int64_t keyframe_ns,
                 const Matrix15d& keyframe_covariance, LocalMap* map) {
  const PlacementProblem placement(options, map, keyframe_ns);
  NormalEquations equations(placement.problem());
  equations.Linearize();
  return PlacedCovariance(map->window, keyframe_ns, keyframe_covariance, &equations).value();
}

// Rows of a state in the equations, pose before motion.
std::vector<int> RowsOf(const WindowProblem& problem, const testing::DenseEquations& equations,
                        const FrameState& state) {
  std::vector<int> rows;
  for (const BlockKind kind : {BlockKind::kPose, BlockKind::kMotion}) {
    const int variable = problem.Find({kind, state.t_ns});
    for (int i = 0; i < VariableTypeOf(kind).tangent_size; ++i) {
      rows.push_back(equations.offset[variable] + i);
    }
  }
  return rows;
}

Eigen::MatrixXd Submatrix(const Eigen::MatrixXd& matrix, const std::vector<int>& rows,
                          const std::vector<int>& columns) {
  return Eigen::MatrixXd::NullaryExpr(
      rows.size(), columns.size(),
      [&](Eigen::Index row, Eigen::Index column) { return matrix(rows[row], columns[column]); });
}

// The third of four frames and the newest are placed relative to the second one, the keyframe.
class PlacedCovarianceTest : public ::testing::Test {
 protected:
  static constexpr size_t kKeyframe = 1;

  FrameState& state(size_t frame) { return simulated_.window.frames[frame].state; }

  Matrix15d Placed() {
    return plm_vins::Placed(options_, state(kKeyframe).t_ns, SomeCovariance(), &simulated_);
  }

  int AddPose(int64_t t_ns, WindowProblem* problem) {
    return problem->AddVariable({BlockKind::kPose, t_ns},
                                simulated_.window.StateAt(t_ns).pose.data());
  }

  // Adds the states from the keyframe on, and the IMU terms between them.
  void AddStates(WindowProblem* problem) {
    const auto motion = [&](size_t i) {
      return problem->AddVariable({BlockKind::kMotion, state(i).t_ns}, state(i).motion.data());
    };
    for (size_t i = kKeyframe + 1; i < 4; ++i) {
      problem->AddTerm(ImuFactor(simulated_.window.frames[i].motion_since_previous.get(),
                                 simulated_.window.gravity_W),
                       nullptr,
                       {AddPose(state(i - 1).t_ns, problem), motion(i - 1),
                        AddPose(state(i).t_ns, problem), motion(i)});
    }
  }

  // Adds points as constants in the keyframe's camera, with their later observations.
  void AddPoints(PointMap* in_keyframe, WindowProblem* problem) {
    SlidingWindow& window = simulated_.window;
    const int extrinsic =
        problem->AddVariable({BlockKind::kExtrinsic, 0}, window.cameras[0].extrinsics.data(), true);
    const int td = problem->AddVariable({BlockKind::kTimeOffset, 0}, &window.td, true);
    for (auto& [id, landmark] : in_keyframe->landmarks()) {
      MoveHost(window, kKeyframe, &landmark);
      const int point =
          problem->AddVariable({BlockKind::kPoint, id}, landmark.coordinates.data(), true);
      for (size_t i = kKeyframe + 1; i < landmark.observations.size(); ++i) {
        const PointLandmark::Observation& observation = landmark.observations[i];
        const ChainKind of_other{/*same_frame=*/false, /*same_camera=*/true};
        problem->AddTerm(
            PointFactor(of_other, observation.bearing, options_.cameras[0].point_weight), &loss_,
            {extrinsic, AddPose(state(kKeyframe).t_ns, problem), AddPose(observation.t_ns, problem),
             td, point});
      }
    }
  }

  testing::SimulatedWindow simulated_ = testing::SimulateWindow(4);
  ProblemOptions options_ = testing::OnePixelOptions();
  ceres::CauchyLoss loss_{options_.point_loss_scale};
};

TEST_F(PlacedCovarianceTest, IsPropagatedByTheImuWithoutLandmarks) {
  const auto all = [](const auto&) { return true; };
  simulated_.points.RemoveIf(all);
  simulated_.lines.RemoveIf(all);
  UncertainState expected{state(kKeyframe), SomeCovariance()};
  for (size_t i = kKeyframe + 1; i < 4; ++i) {
    WindowFrame& frame = simulated_.window.frames[i];
    const int64_t t_ns = frame.state.t_ns;
    expected = Propagate(expected, *frame.motion_since_previous, simulated_.window.gravity_W);
    frame.state = expected.state;
    frame.state.t_ns = t_ns;
  }
  EXPECT_MATRIX_NEAR(Scaled(Placed()), Scaled(expected.covariance), 1e-6);
}

// Points that are constant in the keyframe's camera move exactly with it, so the minimum follows
// the keyframe's state as predicted.
TEST_F(PlacedCovarianceTest, LandmarksMoveWithTheKeyframe) {
  simulated_.lines.RemoveIf([](const auto&) { return true; });
  simulated_.points.RemoveIf([&](const PointLandmark& landmark) {
    return !IsOptimized(landmark) || landmark.host().t_ns != state(0).t_ns;
  });
  ASSERT_GT(simulated_.points.landmarks().size(), 8u);
  PointMap in_keyframe = simulated_.points;
  WindowProblem problem;
  AddStates(&problem);
  AddPoints(&in_keyframe, &problem);
  const testing::DenseEquations equations =
      testing::BuildDenseEquations(problem, NormalEquations(problem));
  const auto rows = [&](size_t frame) { return RowsOf(problem, equations, state(frame)); };
  const std::vector<int> of_keyframe = rows(kKeyframe), of_newest = rows(3);
  std::vector<int> of_others = rows(2);
  of_others.insert(of_others.end(), of_newest.begin(), of_newest.end());
  const Eigen::MatrixXd P = Submatrix(equations.H, of_others, of_others).inverse();
  const Eigen::MatrixXd S = -P * Submatrix(equations.H, of_others, of_keyframe);
  const Eigen::MatrixXd exact = P + S * SomeCovariance() * S.transpose();
  EXPECT_MATRIX_NEAR(Scaled(Placed()), Scaled(exact.bottomRightCorner<15, 15>()), 1e-6);
}

// The whole window gives nearly the same result, although landmarks do not move exactly like a
// rigid body.
TEST(PlacedCovariance, IsCloseToThatOfTheWindow) {
  testing::SimulatedWindow simulated = testing::SimulateWindow(10, /*seed=*/2, /*stride=*/3, 80);
  SlidingWindow& window = simulated.window;
  const ProblemOptions options = testing::OnePixelOptions();
  const MarginalizationPrior prior = InitialPrior(InitialUncertainty(), options, window);
  ProblemBuilder builder(options, &window, &prior);
  builder.AddAll(&simulated.points, &simulated.lines);
  NormalEquations equations(builder.problem());
  equations.Linearize();
  const int64_t keyframe_ns = window.frames[7].state.t_ns;
  const Matrix15d exact = StateCovariance(window.newest().state.t_ns, &equations).value();
  const Matrix15d placed =
      Placed(options, keyframe_ns, StateCovariance(keyframe_ns, &equations).value(), &simulated);
  const Vector15d ratios = (placed.diagonal().cwiseQuotient(exact.diagonal())).cwiseSqrt();
  EXPECT_GT(ratios.minCoeff(), 0.97);
  EXPECT_LT(ratios.maxCoeff(), 1.03);
}

TEST_F(PlacedCovarianceTest, IsUnknownIfUnobservable) {
  WindowProblem without_terms;
  for (size_t i = kKeyframe + 1; i < simulated_.window.frames.size(); ++i) {
    AddPose(state(i).t_ns, &without_terms);
    without_terms.AddVariable({BlockKind::kMotion, state(i).t_ns}, state(i).motion.data());
  }
  NormalEquations equations(without_terms);
  equations.Linearize();
  EXPECT_EQ(StateCovariance(state(kKeyframe + 1).t_ns, &equations), std::nullopt);
  EXPECT_EQ(
      PlacedCovariance(simulated_.window, state(kKeyframe).t_ns, SomeCovariance(), &equations),
      std::nullopt);
}

}  // namespace
}  // namespace plm_vins
