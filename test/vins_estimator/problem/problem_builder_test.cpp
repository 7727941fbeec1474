// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/problem_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "simulator/default_sensors.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/equations/term_evaluation.h"
#include "vins_estimator/problem/initial_prior.h"

namespace plm_vins {
namespace {

class ProblemBuilderTest : public ::testing::Test {
 protected:
  ProblemBuilderTest() : simulated_(testing::SimulateWindow(3)) {}

  SlidingWindow& window() { return simulated_.window; }
  int64_t Stamp(size_t frame) { return window().frames[frame].state.t_ns; }
  PointLandmark* LongestTrack() { return LongestTrackOf(&simulated_.points.landmarks()); }
  LineLandmark* LongestLineTrack() { return LongestTrackOf(&simulated_.lines.landmarks()); }

  template <typename Landmark>
  static Landmark* LongestTrackOf(std::map<int64_t, Landmark>* landmarks) {
    const auto longest =
        std::max_element(landmarks->begin(), landmarks->end(), [](const auto& a, const auto& b) {
          return a.second.observations.size() < b.second.observations.size();
        });
    return &longest->second;
  }

  testing::SimulatedWindow simulated_;
  MarginalizationPrior no_prior_;
  ProblemOptions options_ = testing::OnePixelOptions();
};

TEST_F(ProblemBuilderTest, MotionJoinsTwoFrames) {
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddMotion(1);
  const WindowProblem& problem = builder.problem();
  ASSERT_EQ(problem.variables().size(), 4u);
  ASSERT_EQ(problem.terms().size(), 1u);
  for (const size_t frame : {0, 1}) {
    FrameState& state = window().frames[frame].state;
    const int pose = problem.Find({BlockKind::kPose, state.t_ns});
    const int motion = problem.Find({BlockKind::kMotion, state.t_ns});
    ASSERT_TRUE(pose >= 0 && motion >= 0);
    EXPECT_EQ(problem.variables()[pose].values, state.pose.data());
    EXPECT_EQ(problem.variables()[motion].values, state.motion.data());
  }
  EXPECT_EQ(problem.Find({BlockKind::kPose, Stamp(2)}), -1);
}

TEST_F(ProblemBuilderTest, StandstillAddsZeroVelocityAndSamePose) {
  window().frames[2].stationary = true;
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddMotion(2);
  const auto& terms = builder.problem().terms();
  ASSERT_EQ(terms.size(), 3u);
  EXPECT_EQ(terms[1].cost->num_residuals(), 3);
  EXPECT_EQ(terms[1].variables[0], builder.problem().Find({BlockKind::kMotion, Stamp(2)}));
  EXPECT_EQ(terms[2].cost->num_residuals(), 6);
  EXPECT_EQ(terms[2].variables[0], builder.problem().Find({BlockKind::kPose, Stamp(1)}));
  EXPECT_EQ(terms[2].variables[1], builder.problem().Find({BlockKind::kPose, Stamp(2)}));
}

// Standard deviations are inversely proportional to residuals.
TEST_F(ProblemBuilderTest, StandstillDeviationsHaveALowerBound) {
  window().frames[2].stationary = true;
  const auto residuals = [this](int term) {
    ProblemBuilder builder(options_, &window(), &no_prior_);
    builder.AddMotion(2);
    const auto& evaluated = builder.problem().terms()[static_cast<size_t>(term)];
    std::vector<const double*> values;
    for (const int variable : evaluated.variables) {
      values.push_back(builder.problem().variables()[static_cast<size_t>(variable)].values);
    }
    Eigen::VectorXd result(evaluated.cost->num_residuals());
    evaluated.cost->Evaluate(values.data(), result.data(), nullptr);
    return result;
  };
  const Eigen::VectorXd velocity = residuals(1), pose = residuals(2);
  options_.passing_velocity = 0.0049;
  EXPECT_MATRIX_NEAR(residuals(1), velocity, 1e-12);
  options_.passing_velocity = 0.05;
  options_.passing_turn_rate = 0.02;
  const double interval = ToSeconds(Stamp(2) - Stamp(1));
  EXPECT_MATRIX_NEAR(residuals(1), velocity / 10, 1e-9);
  const Eigen::VectorXd weaker = residuals(2);
  EXPECT_MATRIX_NEAR(weaker.head<3>(), pose.head<3>() * 0.001 / (0.05 * interval), 1e-9);
  EXPECT_MATRIX_NEAR(weaker.tail<3>(), pose.tail<3>() * 0.0005 / (0.02 * interval), 1e-9);
}

TEST_F(ProblemBuilderTest, PointHasATermForEveryObservation) {
  PointLandmark* landmark = LongestTrack();
  ASSERT_EQ(landmark->observations.size(), 3u);
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddPoint(landmark);
  const WindowProblem& problem = builder.problem();
  ASSERT_EQ(problem.landmarks().size(), 1u);
  EXPECT_EQ(problem.landmarks()[0].terms.size(), 3u);
  EXPECT_EQ(problem.landmarks()[0].terms[0].variable_count, 2);  // the host's own observation
  EXPECT_EQ(problem.variables()[problem.landmarks()[0].variable].values,
            landmark->coordinates.data());
  EXPECT_EQ(problem.variables().size(), 6u);  // three poses, point, extrinsics, time offset
}

TEST_F(ProblemBuilderTest, LineHasATermForEveryObservation) {
  LineLandmark* landmark = LongestLineTrack();
  ASSERT_EQ(landmark->observations.size(), 3u);
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddLine(landmark);
  const WindowProblem& problem = builder.problem();
  ASSERT_EQ(problem.landmarks().size(), 1u);
  const LandmarkTerms& line = problem.landmarks()[0];
  ASSERT_EQ(line.terms.size(), 3u);
  EXPECT_EQ(line.terms[0].variable_count, 1);  // the host's own observation
  EXPECT_EQ(line.variable, problem.Find({BlockKind::kLine, landmark->id}));
  EXPECT_EQ(problem.variables()[line.variable].values, landmark->coordinates.data());
  EXPECT_EQ(problem.variables().size(), 5u);  // three poses, line, extrinsics
  for (size_t i = 1; i < 3; ++i) {
    ASSERT_EQ(line.terms[i].variable_count, 4);
    EXPECT_EQ(line.terms[i].variables[1], problem.Find({BlockKind::kPose, Stamp(0)}));
    EXPECT_EQ(line.terms[i].variables[2], problem.Find({BlockKind::kPose, Stamp(i)}));
  }
}

TEST_F(ProblemBuilderTest, AnchorObservationsHaveTheirOwnWeight) {
  LineLandmark* landmark = LongestLineTrack();
  ASSERT_EQ(landmark->observations.size(), 3u);
  MoveHost(window(), 1, landmark);
  landmark->anchor_observations = {landmark->observations[0]};
  landmark->observations.erase(landmark->observations.begin());
  const BlockId anchor_pose{BlockKind::kPose, Stamp(0)};
  window().TurnOldestIntoAnchor();
  const auto cost_of_observations = [&] {
    options_.line_loss_scale = 1e6;  // practically none
    ProblemBuilder builder(options_, &window(), &no_prior_);
    builder.AddLine(landmark);
    const WindowProblem& problem = builder.problem();
    const auto& terms = problem.landmarks()[0].terms;
    EXPECT_EQ(terms.size(), 3u);
    const ResidualTerm& of_anchor = terms.back();
    EXPECT_EQ(of_anchor.variables[1], problem.Find({BlockKind::kPose, Stamp(0)}));  // the host
    EXPECT_EQ(of_anchor.variables[2], problem.Find(anchor_pose));
    EXPECT_EQ(problem.variables()[of_anchor.variables[2]].values,
              window().anchors[0].state.pose.data());
    return std::make_pair(EvaluateTermCost(terms[1], problem.variables()),
                          EvaluateTermCost(of_anchor, problem.variables()));
  };
  options_.anchor_weight = 50;
  const auto [observation, in_anchor] = cost_of_observations();
  options_.anchor_weight = 150;
  const auto [same, in_heavier_anchor] = cost_of_observations();
  EXPECT_GT(in_anchor, 0);
  EXPECT_NEAR(in_heavier_anchor, 9 * in_anchor, 1e-6 * in_heavier_anchor);
  EXPECT_EQ(same, observation);
}

TEST_F(ProblemBuilderTest, APointAndALineMayHaveTheSameId) {
  PointLandmark* point = LongestTrack();
  LineLandmark* line = LongestLineTrack();
  point->id = line->id = 5;
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddPoint(point);
  builder.AddLine(line);
  EXPECT_EQ(builder.problem().landmarks().size(), 2u);
  EXPECT_EQ(builder.problem().variables().size(), 7u);
}

TEST_F(ProblemBuilderTest, CalibrationIsConstantUnlessItIsEstimated) {
  for (const bool extrinsic : {false, true}) {
    for (const bool td : {false, true}) {
      options_.estimate_extrinsic = extrinsic;
      options_.estimate_td = td;
      ProblemBuilder builder(options_, &window(), &no_prior_);
      builder.AddPoint(LongestTrack());
      const WindowProblem& problem = builder.problem();
      const auto& variables = problem.variables();
      EXPECT_EQ(variables[problem.Find({BlockKind::kExtrinsic, 0})].constant, !extrinsic);
      EXPECT_EQ(variables[problem.Find({BlockKind::kTimeOffset, 0})].constant, !td);
      EXPECT_EQ(NormalEquations(problem).dense_size(), 18 + 6 * extrinsic + td);
    }
  }
}

TEST_F(ProblemBuilderTest, TheIntrinsicsAreAVariableOfPointsAndLinesWhereTheyAreEstimated) {
  for (const bool intrinsics : {false, true}) {
    options_.estimate_intrinsics = intrinsics;
    ProblemBuilder points(options_, &window(), &no_prior_), lines(options_, &window(), &no_prior_);
    points.AddPoint(LongestTrack());
    lines.AddLine(LongestLineTrack());
    for (const ProblemBuilder* builder : {&points, &lines}) {
      const WindowProblem& problem = builder->problem();
      const int variable = problem.Find({BlockKind::kIntrinsics, 0});
      EXPECT_EQ(variable >= 0, intrinsics);
      EXPECT_EQ(NormalEquations(problem).dense_size(), 18 + 8 * intrinsics);
      for (const ResidualTerm& term : problem.landmarks()[0].terms) {
        const auto last = term.variables.begin() + term.variable_count;
        EXPECT_EQ(std::find(term.variables.begin(), last, variable) != last, intrinsics);
      }
    }
  }
}

TEST_F(ProblemBuilderTest, TimeOffsetAndIntrinsicsGoTogether) {
  options_.estimate_td = options_.estimate_intrinsics = true;
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddPoint(LongestTrack());
  EXPECT_EQ(builder.problem().landmarks()[0].terms[1].variable_count, 6);
  NormalEquations equations(builder.problem());
  EXPECT_EQ(equations.dense_size(), 18 + 1 + 8);
  EXPECT_TRUE(std::isfinite(equations.Linearize()));
}

TEST_F(ProblemBuilderTest, PriorVariablesUseFirstEstimatesIfConfigured) {
  const MarginalizationPrior prior = InitialPrior(InitialUncertainty(), options_, window());
  for (const JacobiansAt jacobians_at : {JacobiansAt::kFirstEstimates, JacobiansAt::kValues}) {
    options_.jacobians_at = jacobians_at;
    ProblemBuilder builder(options_, &window(), &prior);
    builder.AddPrior();
    builder.AddMotion(1);
    const WindowProblem& problem = builder.problem();
    EXPECT_EQ(problem.prior(), &prior);
    const BlockId first{BlockKind::kPose, Stamp(0)}, second{BlockKind::kPose, Stamp(1)};
    EXPECT_EQ(problem.variables()[problem.Find(first)].linearization,
              jacobians_at == JacobiansAt::kFirstEstimates ? prior.Linearization(first) : nullptr);
    EXPECT_EQ(problem.variables()[problem.Find(second)].linearization, nullptr);
  }
}

TEST_F(ProblemBuilderTest, ConsistentDataCostsLittleAtTheTruth) {
  ProblemBuilder builder(options_, &window(), &no_prior_);
  for (size_t i = 1; i < window().frames.size(); ++i) builder.AddMotion(i);
  int rows = 30;
  for (auto& [id, landmark] : simulated_.points.landmarks()) {
    if (!landmark.triangulated) continue;
    builder.AddPoint(&landmark);
    rows += 2 * static_cast<int>(landmark.observations.size());
  }
  for (auto& [id, landmark] : simulated_.lines.landmarks()) {
    if (!landmark.triangulated) continue;
    builder.AddLine(&landmark);
    rows += 2 * static_cast<int>(landmark.observations.size());
  }
  EXPECT_LT(NormalEquations(builder.problem()).Cost(), 0.5 * rows);
}

// The second camera observes the points of the first one.
class ProblemOfTwoCameras : public ProblemBuilderTest {
 protected:
  ProblemOfTwoCameras() {
    Config config;
    config.sensor = simulator::DefaultStereoSensors();
    options_ = ProblemOptions(config, 460);
    window().cameras.resize(2);
    for (int i = 0; i < 2; ++i) {
      window().cameras[i].SetExtrinsics(config.sensor.cameras[i].T_B_C);
    }
  }

  static const Variable* Find(const WindowProblem& problem, const BlockId& id) {
    const int index = problem.Find(id);
    return index < 0 ? nullptr : &problem.variables()[index];
  }
};

TEST_F(ProblemOfTwoCameras, ExtrinsicsOfTheSecondAreEstimatedAndTiedToTheFirst) {
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddExtrinsicsPriors();
  const WindowProblem& problem = builder.problem();
  ASSERT_EQ(problem.terms().size(), 1u);
  EXPECT_TRUE(Find(problem, {BlockKind::kExtrinsic, 0})->constant);
  EXPECT_FALSE(Find(problem, {BlockKind::kExtrinsic, 1})->constant);
  EXPECT_NEAR(NormalEquations(problem).Cost(), 0, 1e-12);
}

TEST_F(ProblemOfTwoCameras, AnObservationDependsOnTheVariablesThatDoNotCancel) {
  PointLandmark* point = LongestTrack();
  ASSERT_GE(point->observations.size(), 2u);
  point->observations.resize(2);
  PointLandmark::Observation of_second = point->host();
  of_second.camera = 1;
  point->observations.insert(point->observations.begin() + 1, of_second);
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddPoint(point);
  const auto& terms = builder.problem().landmarks().at(0).terms;
  ASSERT_EQ(terms.size(), 3u);
  EXPECT_EQ(terms[0].variable_count, 2) << "host: time offset and point";
  EXPECT_EQ(terms[1].variable_count, 4) << "host frame: and both extrinsics";
  EXPECT_EQ(terms[2].variable_count, 5) << "host camera: and two poses, and its extrinsics";
}

// The other observations stay with the new host and are marginalized later.
TEST_F(ProblemOfTwoCameras, MarginalizesOnlyTheFirstObservationOfTheNewestFrame) {
  PointLandmark* point = LongestTrack();
  PointLandmark::Observation of_second = point->observations.back();
  of_second.camera = 1;
  point->observations.push_back(of_second);
  ProblemBuilder builder(options_, &window(), &no_prior_);
  builder.AddPoint(point, /*until_ns=*/of_second.t_ns);
  EXPECT_EQ(builder.problem().landmarks().at(0).terms.size(), point->observations.size() - 1);
}

}  // namespace
}  // namespace plm_vins
