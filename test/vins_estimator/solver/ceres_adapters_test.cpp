// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/solver/ceres_adapters.h"

#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/factors/zero_velocity_factor.h"

namespace plm_vins {
namespace {

using Pose = Eigen::Matrix<double, kPoseSize, 1>;
using Tangent = Eigen::Matrix<double, kPoseTangentSize, 1>;

Pose RandomPose(simulator::Random* random) {
  Pose identity, pose;
  identity << 0, 0, 0, 0, 0, 0, 1;
  Tangent delta;
  delta << random->UniformInBox({1.7, 1.7, 1.7}), random->UniformInBox({1.7, 1.7, 1.7});
  PosePlus(identity.data(), delta.data(), pose.data());
  return pose;
}

// Ceres multiplies a cost function's padded Jacobian by PlusJacobian, which must preserve the
// tangent part.
TEST(TangentManifold, CeresSolvesWithTangentJacobians) {
  simulator::Random random(6);
  Pose fixed = RandomPose(&random);
  Pose free = RandomPose(&random);
  ceres::Problem problem;
  const SamePoseFactor factor(0.1, 0.1);
  problem.AddResidualBlock(new FactorCost(&factor, {kPoseSize, kPoseSize}), nullptr, fixed.data(),
                           free.data());
  SetManifold(&problem, fixed.data(), PoseVariable());
  SetManifold(&problem, free.data(), PoseVariable());
  problem.SetParameterBlockConstant(fixed.data());
  ceres::Solver::Options options;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-16;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Tangent difference;
  PoseMinus(free.data(), fixed.data(), difference.data());
  EXPECT_MATRIX_NEAR(difference, Tangent::Zero(), 1e-9);
  EXPECT_LT(summary.iterations.size(), 15u);
}

#if PLM_CERES_HAS_MANIFOLD
TEST(TangentManifold, JacobiansAreTheStatedIdentities) {
  simulator::Random random(7);
  const Pose x = RandomPose(&random);
  const TangentManifold manifold(PoseVariable());
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
  ASSERT_TRUE(manifold.PlusJacobian(x.data(), plus.data()));
  ASSERT_TRUE(manifold.MinusJacobian(x.data(), minus.data()));
  EXPECT_MATRIX_NEAR(plus.topRows<6>(), (Eigen::Matrix<double, 6, 6>::Identity()), 0.0);
  EXPECT_TRUE(plus.bottomRows<1>().isZero(0.0));
  EXPECT_MATRIX_NEAR(minus * plus, (Eigen::Matrix<double, 6, 6>::Identity()), 0.0);
}
#endif

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
