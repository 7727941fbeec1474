// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <set>
#include <stdexcept>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/equations/dense_equations.h"
#include "test/vins_estimator/simulated_problem.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/problem/problem_builder.h"

namespace plm_vins {
namespace {

using testing::DenseEquations;

// A window of four frames with IMU, points, lines, prior and estimated calibration, at other values
// than the true ones.
class NormalEquationsTest : public ::testing::Test {
 protected:
  NormalEquationsTest() : simulated_(testing::SimulateWindow(4)) {
    options_.estimate_extrinsic = options_.estimate_td = true;
    simulator::Random random(1);
    testing::Disturb(0.01, &random, &simulated_.window);
    prior_ = InitialPrior(InitialUncertainty(), options_, simulated_.window);
    testing::Disturb(0.003, &random, &simulated_.window);  // leaves the linearization points
    simulated_.window.frames.back().stationary = true;
    Build();
  }

  void Build() {
    builder_.emplace(options_, &simulated_.window, &prior_);
    testing::AddAll(&simulated_, &*builder_);
    equations_.emplace(problem());
  }

  const WindowProblem& problem() const { return builder_->problem(); }

  testing::SimulatedWindow simulated_;
  ProblemOptions options_ = testing::OnePixelOptions();
  MarginalizationPrior prior_;
  std::optional<ProblemBuilder> builder_;
  std::optional<NormalEquations> equations_;
};

TEST_F(NormalEquationsTest, CostIsTheSumOfAllTerms) {
  const double cost = equations_->Linearize();
  const DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
  EXPECT_GT(problem().landmarks().size(), 20u);
  EXPECT_NEAR(cost / dense.cost, 1, 1e-12);
  EXPECT_NEAR(equations_->Cost() / dense.cost, 1, 1e-12);
}

TEST_F(NormalEquationsTest, ReducedEquationsAreTheSchurComplementOfAllJacobians) {
  equations_->Linearize();
  for (const double damping : {0.0, 0.1}) {
    Eigen::MatrixXd S;
    Eigen::VectorXd g;
    equations_->Reduce(damping, &S, &g);
    S = Eigen::MatrixXd(S.selfadjointView<Eigen::Upper>());
    DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
    dense.H.diagonal() *= 1 + damping;
    const int size = equations_->dense_size(), rest = static_cast<int>(dense.b.size()) - size;
    const Eigen::MatrixXd H_ld = dense.H.bottomLeftCorner(rest, size);
    const Eigen::MatrixXd H_ll = dense.H.bottomRightCorner(rest, rest);
    const Eigen::MatrixXd expected_S =
        dense.H.topLeftCorner(size, size) - H_ld.transpose() * testing::SolveScaled(H_ll, H_ld);
    const Eigen::VectorXd expected_g =
        dense.b.head(size) - H_ld.transpose() * testing::SolveScaled(H_ll, dense.b.tail(rest));
    const Eigen::VectorXd scale = testing::UnitDiagonalScale(expected_S);
    EXPECT_MATRIX_NEAR(testing::ScaleBothSides(S, scale),
                       testing::ScaleBothSides(expected_S, scale), 1e-8);
    EXPECT_LT((scale.asDiagonal() * (g - expected_g)).norm(),
              1e-8 * (scale.asDiagonal() * expected_g).norm());
  }
}

TEST_F(NormalEquationsTest, StepsSolveTheFullSystem) {
  equations_->Linearize();
  for (const double damping : {0.0, 0.1}) {
    const Eigen::VectorXd step = equations_->DenseStep(damping);
    DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
    dense.H.diagonal() *= 1 + damping;
    const Eigen::VectorXd expected = -testing::SolveScaled(dense.H, dense.b);
    EXPECT_MATRIX_NEAR(step, expected.head(step.size()), 1e-6);
    std::set<int> sizes;
    for (size_t i = 0; i < problem().landmarks().size(); ++i) {
      const int variable = problem().landmarks()[i].variable;
      const int size = problem().variables()[variable].type().tangent_size;
      EXPECT_MATRIX_NEAR(equations_->LandmarkStep(static_cast<int>(i), step, damping),
                         expected.segment(dense.offset[variable], size), 1e-6);
      sizes.insert(size);
    }
    EXPECT_EQ(sizes, (std::set<int>{kPointSize, kLineTangentSize}));
  }
}

TEST_F(NormalEquationsTest, GainIsThatOfTheQuadraticModel) {
  equations_->Linearize();
  const DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
  for (const double damping : {0.0, 0.1, 10.0}) {
    const Eigen::VectorXd dense_step = equations_->DenseStep(damping);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(dense.b.size());
    step.head(dense_step.size()) = dense_step;
    double gain = equations_->DenseGain(dense_step, damping);
    for (size_t i = 0; i < problem().landmarks().size(); ++i) {
      const int index = static_cast<int>(i);
      const LandmarkVector part = equations_->LandmarkStep(index, dense_step, damping);
      step.segment(dense.offset[problem().landmarks()[i].variable], part.size()) = part;
      gain += equations_->LandmarkGain(index, part, damping);
    }
    const double expected = -dense.b.dot(step) - 0.5 * step.dot(dense.H * step);
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(gain / expected, 1, 1e-6) << damping;
  }
}

TEST_F(NormalEquationsTest, CovarianceIsTheInverseOfTheFullInformation) {
  equations_->Linearize();
  const int64_t oldest = simulated_.window.frames.front().state.t_ns;
  const int64_t newest = simulated_.window.newest().state.t_ns;
  const std::vector<BlockId> ids = {{BlockKind::kMotion, newest}, {BlockKind::kPose, oldest}};
  const Eigen::MatrixXd covariance = equations_->Covariance(ids).value();
  ASSERT_EQ(covariance.rows(), 15);

  const DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
  const Eigen::MatrixXd inverse =
      testing::SolveScaled(dense.H, Eigen::MatrixXd::Identity(dense.H.rows(), dense.H.rows()));
  Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(15, dense.H.rows());
  selection.block<9, 9>(0, dense.offset[problem().Find(ids[0])]).setIdentity();
  selection.block<6, 6>(9, dense.offset[problem().Find(ids[1])]).setIdentity();
  const Eigen::MatrixXd expected = selection * inverse * selection.transpose();
  const Eigen::VectorXd scale = testing::UnitDiagonalScale(expected);
  EXPECT_MATRIX_NEAR(testing::ScaleBothSides(covariance, scale),
                     testing::ScaleBothSides(expected, scale), 1e-6);
}

TEST_F(NormalEquationsTest, CovarianceIsThatOfTheUndampedEquationsWhateverWasSolvedBefore) {
  const int64_t newest = simulated_.window.newest().state.t_ns;
  const auto covariance = [&] {
    return equations_->Covariance({{BlockKind::kPose, newest}}).value();
  };
  equations_->Linearize();
  const Eigen::MatrixXd expected = covariance();
  ASSERT_GT(equations_->DenseStep(0.1).size(), 0);
  EXPECT_EQ(covariance(), expected);
  simulated_.window.frames.back().state.pose[0] += 0.1;
  equations_->Linearize();
  EXPECT_NE(covariance(), expected);
}

TEST_F(NormalEquationsTest, RejectsTheCovarianceOfOtherVariables) {
  equations_->Linearize();
  EXPECT_THROW(equations_->Covariance({{BlockKind::kPose, 12345}}), std::invalid_argument);
}

TEST_F(NormalEquationsTest, WithoutAnchorThereIsNoCovariance) {
  WindowProblem problem;
  std::array<double, 9> motion = {};
  problem.AddVariable({BlockKind::kMotion, 1}, motion.data());
  NormalEquations equations(problem);
  EXPECT_EQ(equations.Linearize(), 0);
  EXPECT_FALSE(equations.Covariance({{BlockKind::kMotion, 1}}));
  EXPECT_EQ(equations.DenseStep(0).size(), 0);
}

TEST_F(NormalEquationsTest, TermsThatCannotBeEvaluatedInitiallyAreIgnored) {
  const Variable& point = problem().variables()[problem().landmarks()[0].variable];
  ASSERT_EQ(point.id.kind, BlockKind::kPoint);
  const double all = equations_->Cost();
  point.values[2] = -point.values[2];  // behind its host
  const double rest = equations_->Linearize();
  EXPECT_LT(rest, all);
  EXPECT_NEAR(equations_->Cost() / rest, 1, 1e-12);
  point.values[2] = -point.values[2];
  EXPECT_NEAR(equations_->Cost() / rest, 1, 1e-12);
  EXPECT_NEAR(equations_->Linearize() / rest, 1, 1e-12);
}

TEST_F(NormalEquationsTest, ATermThatCanNoLongerBeEvaluatedMakesTheCostInfinite) {
  equations_->Linearize();
  const Variable& point = problem().variables()[problem().landmarks()[0].variable];
  point.values[2] = -point.values[2];
  EXPECT_EQ(equations_->Cost(), std::numeric_limits<double>::infinity());
}

TEST_F(NormalEquationsTest, GradientIsTheDerivativeOfTheCost) {
  options_.jacobians_at = JacobiansAt::kValues;
  Build();
  equations_->Linearize();
  const DenseEquations dense = testing::BuildDenseEquations(problem(), *equations_);
  for (size_t i = 0; i < problem().variables().size(); ++i) {
    const Variable& variable = problem().variables()[i];
    const VariableType& type = variable.type();
    const Eigen::VectorXd x = Eigen::Map<Eigen::VectorXd>(variable.values, type.ambient_size);
    const auto cost = [&](const Eigen::VectorXd& moved) {
      std::copy(moved.data(), moved.data() + moved.size(), variable.values);
      return Eigen::VectorXd(Eigen::VectorXd::Constant(1, equations_->Cost()));
    };
    const auto plus = [&](const Eigen::VectorXd& point, const Eigen::VectorXd& delta) {
      Eigen::VectorXd moved(type.ambient_size);
      type.plus(point.data(), delta.data(), moved.data());
      return moved;
    };
    const Eigen::VectorXd numeric =
        testing::NumericJacobian(cost, x, type.tangent_size, plus).transpose();
    cost(x);
    const Eigen::VectorXd analytic = dense.b.segment(dense.offset[i], type.tangent_size);
    EXPECT_LT((numeric - analytic).norm(), 1e-4 * (1 + analytic.norm())) << "variable " << i;
  }
}

}  // namespace
}  // namespace plm_vins
