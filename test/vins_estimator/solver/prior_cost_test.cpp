// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/prior_cost.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A prior on a pose and a time offset, with information of the given rank and very different
// scales.
class PriorCostTest : public ::testing::TestWithParam<int> {
 protected:
  static constexpr int kSize = 7;

  PriorCostTest() {
    simulator::Random random(1);
    testing::Disturb(1.0, &random, &state_);
    std::vector<MarginalizationPrior::Block> blocks(2);
    blocks[0] = {{BlockKind::kTimeOffset, 0}, 6, {td_}};
    blocks[1] = {{BlockKind::kPose, 5}, 0, {}};
    std::copy(state_.pose.begin(), state_.pose.end(), blocks[1].linearization.begin());
    MatrixXd J(GetParam(), kSize);
    for (int i = 0; i < J.size(); ++i) J.data()[i] = random.Normal();
    J.col(2) *= 1e5;
    const VectorXd r = testing::NormalVector(GetParam(), &random);
    prior_ = MarginalizationPrior(blocks, {J.transpose() * J, J.transpose() * r});
    problem_.AddVariable(blocks[1].id, state_.pose.data());
    problem_.AddVariable(blocks[0].id, &td_);
  }

  void Move(const VectorXd& delta) {
    PosePlus(state_.pose.data(), delta.data(), state_.pose.data());
    td_ += delta[6];
  }

  VectorXd Residual(const PriorCost& cost, double** jacobians = nullptr) const {
    const double* parameters[] = {&td_, state_.pose.data()};
    VectorXd residual(cost.num_residuals());
    EXPECT_TRUE(cost.Evaluate(parameters, residual.data(), jacobians));
    return residual;
  }

  FrameState state_;
  double td_ = 0.01;
  MarginalizationPrior prior_;
  WindowProblem problem_;
};

INSTANTIATE_TEST_SUITE_P(Rank, PriorCostTest, ::testing::Values(3, 6, 7));

TEST_P(PriorCostTest, IsThePriorUpToItsConstant) {
  const PriorCost cost(prior_);
  simulator::Random random(2);
  for (int i = 0; i < 10; ++i) {
    Move(0.1 * testing::NormalVector(kSize, &random));
    const double expected = prior_.Cost(problem_) + cost.constant();
    EXPECT_NEAR(0.5 * Residual(cost).squaredNorm() / expected, 1, 1e-9);
  }
}

TEST_P(PriorCostTest, JacobiansGiveItsGradientAndInformation) {
  const PriorCost cost(prior_);
  simulator::Random random(3);
  const VectorXd delta = 0.1 * testing::NormalVector(kSize, &random);
  Move(delta);
  RowMajorMatrix d_td(kSize, 1), d_pose(kSize, 7);
  double* jacobians[] = {d_td.data(), d_pose.data()};
  const VectorXd residual = Residual(cost, jacobians);
  EXPECT_TRUE(d_pose.col(6).isZero(0));
  MatrixXd J(kSize, kSize);
  J << d_pose.leftCols(6), d_td;
  const Quadratic& q = prior_.quadratic();
  const VectorXd scale = q.H.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_MATRIX_NEAR(MatrixXd(scale.asDiagonal() * (J.transpose() * J - q.H) * scale.asDiagonal()),
                     MatrixXd::Zero(kSize, kSize), 1e-12);
  const VectorXd gradient = q.H * delta + q.b;
  EXPECT_LT(scale.cwiseProduct(J.transpose() * residual - gradient).norm(),
            1e-9 * scale.cwiseProduct(gradient).norm());
}

TEST_P(PriorCostTest, AcceptsMissingJacobians) {
  const PriorCost cost(prior_);
  RowMajorMatrix d_pose(kSize, 7);
  double* jacobians[] = {nullptr, d_pose.data()};
  EXPECT_TRUE(Residual(cost, jacobians).allFinite());
  EXPECT_TRUE(d_pose.allFinite());
}

}  // namespace
}  // namespace plm_vins
