// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/marginalization_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd RandomMatrix(int rows, int columns, simulator::Random* random) {
  MatrixXd result(rows, columns);
  for (int i = 0; i < rows * columns; ++i) result.data()[i] = random->Normal();
  return result;
}

// The quadratic function |J x - r|^2 / 2.
Quadratic LeastSquares(const MatrixXd& J, const VectorXd& r) {
  return {J.transpose() * J, -J.transpose() * r};
}

double Evaluate(const Quadratic& quadratic, const VectorXd& x) {
  return 0.5 * x.dot(quadratic.H * x) + quadratic.b.dot(x);
}

TEST(MarginalizeFirst, EqualsTheClosedForm) {
  simulator::Random random(1);
  const Quadratic all = LeastSquares(RandomMatrix(20, 7, &random), RandomMatrix(20, 1, &random));
  const Quadratic kept = MarginalizeFirst(all, 3);
  const MatrixXd H_rm = all.H.bottomLeftCorner(4, 3), H_mm = all.H.topLeftCorner(3, 3);
  EXPECT_MATRIX_NEAR(
      kept.H, all.H.bottomRightCorner(4, 4) - H_rm * H_mm.inverse() * H_rm.transpose(), 1e-11);
  EXPECT_MATRIX_NEAR(kept.b, all.b.tail(4) - H_rm * H_mm.inverse() * all.b.head(3), 1e-11);
  EXPECT_MATRIX_NEAR(kept.H, kept.H.transpose(), 0.0);
}

TEST(MarginalizeFirst, IsTheMinimumOverTheFirstComponents) {
  simulator::Random random(2);
  const Quadratic all = LeastSquares(RandomMatrix(9, 5, &random), RandomMatrix(9, 1, &random));
  const Quadratic kept = MarginalizeFirst(all, 2);
  const auto minimum_at = [&all](const VectorXd& rest) {
    VectorXd x(5);
    const VectorXd slope = all.b.head(2) + all.H.topRightCorner(2, 3) * rest;
    x << -all.H.topLeftCorner(2, 2).inverse() * slope, rest;
    return Evaluate(all, x);
  };
  const double offset = minimum_at(VectorXd::Zero(3));
  for (int i = 0; i < 10; ++i) {
    const VectorXd rest = RandomMatrix(3, 1, &random);
    EXPECT_NEAR(Evaluate(kept, rest), minimum_at(rest) - offset, 1e-10);
  }
}

// Early data is marginalized into a prior before late data arrives; the result equals the batch
// solution.
TEST(MarginalizeFirst, FilteringEqualsTheBatchSolution) {
  simulator::Random random(3);
  const MatrixXd early = RandomMatrix(12, 6, &random), late = RandomMatrix(10, 4, &random);
  const VectorXd early_r = RandomMatrix(12, 1, &random), late_r = RandomMatrix(10, 1, &random);

  MatrixXd batch(22, 6);  // the late data does not depend on the first two components
  batch << early, MatrixXd::Zero(10, 2), late;
  VectorXd batch_r(22);
  batch_r << early_r, late_r;
  const Quadratic all = LeastSquares(batch, batch_r);
  const VectorXd expected = -all.H.ldlt().solve(all.b);

  const Quadratic prior = MarginalizeFirst(LeastSquares(early, early_r), 2);
  const Quadratic update = LeastSquares(late, late_r);
  const VectorXd solution = -(prior.H + update.H).ldlt().solve(prior.b + update.b);
  EXPECT_MATRIX_NEAR(solution, expected.tail(4), 1e-10);
}

TEST(MarginalizeFirst, OrderDoesNotMatter) {
  simulator::Random random(4);
  const Quadratic all = LeastSquares(RandomMatrix(20, 6, &random), RandomMatrix(20, 1, &random));
  const Quadratic at_once = MarginalizeFirst(all, 3);
  const Quadratic in_steps = MarginalizeFirst(MarginalizeFirst(all, 1), 2);
  EXPECT_MATRIX_NEAR(in_steps.H, at_once.H, 1e-11);
  EXPECT_MATRIX_NEAR(in_steps.b, at_once.b, 1e-11);
}

TEST(MarginalizeFirst, ToleratesScalesOfManyOrdersOfMagnitude) {
  simulator::Random random(5);
  const Quadratic all = LeastSquares(RandomMatrix(20, 5, &random), RandomMatrix(20, 1, &random));
  VectorXd scale(5);
  scale << 1e-6, 1e5, 1, 1e-4, 1e6;
  const Quadratic scaled{scale.asDiagonal() * all.H * scale.asDiagonal(),
                         scale.asDiagonal() * all.b};
  const Quadratic kept = MarginalizeFirst(scaled, 2), expected = MarginalizeFirst(all, 2);
  const VectorXd back = scale.tail(3).cwiseInverse();
  EXPECT_MATRIX_NEAR(back.asDiagonal() * kept.H * back.asDiagonal(), expected.H, 1e-9);
  EXPECT_MATRIX_NEAR(back.asDiagonal() * kept.b, expected.b, 1e-9);
}

// Unobservable directions are dropped, whatever their orientation.
TEST(MarginalizeFirst, TakesSemiDefiniteBlocks) {
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    simulator::Random random(seed);
    MatrixXd J = RandomMatrix(12, 8, &random);
    const MatrixXd left = RandomMatrix(12, 2, &random), right = RandomMatrix(2, 4, &random);
    J.leftCols(4) = left * right;  // rank two
    const Quadratic all = LeastSquares(J, RandomMatrix(12, 1, &random));
    const Quadratic kept = MarginalizeFirst(all, 4);
    const MatrixXd H_rm = all.H.bottomLeftCorner(4, 4);
    // The pseudoinverse of H_mm.
    const MatrixXd P = (right * right.transpose()).inverse() * right;
    const MatrixXd inverse = P.transpose() * (left.transpose() * left).inverse() * P;
    EXPECT_MATRIX_NEAR(kept.H, all.H.bottomRightCorner(4, 4) - H_rm * inverse * H_rm.transpose(),
                       1e-8);
    EXPECT_MATRIX_NEAR(kept.b, all.b.tail(4) - H_rm * inverse * all.b.head(4), 1e-8);
  }
}

TEST(MarginalizeFirst, ComponentsWithoutInformationAreDropped) {
  simulator::Random random(6);
  MatrixXd J = RandomMatrix(12, 5, &random);
  J.col(1).setZero();
  const Quadratic kept = MarginalizeFirst(LeastSquares(J, RandomMatrix(12, 1, &random)), 2);
  EXPECT_TRUE(kept.H.allFinite());
  MatrixXd without(12, 4);
  without << J.col(0), J.rightCols(3);
  EXPECT_MATRIX_NEAR(kept.H, MarginalizeFirst(LeastSquares(without, VectorXd::Zero(12)), 1).H,
                     1e-11);
}

TEST(Permute, MovesRowsAndColumns) {
  simulator::Random random(7);
  const Quadratic all = LeastSquares(RandomMatrix(5, 3, &random), RandomMatrix(5, 1, &random));
  const Quadratic permuted = Permute(all, {2, 0, 1});
  EXPECT_EQ(permuted.b[2], all.b[0]);
  EXPECT_EQ(permuted.b[0], all.b[1]);
  EXPECT_EQ(permuted.H(2, 0), all.H(0, 1));
  EXPECT_EQ(permuted.H(1, 1), all.H(2, 2));
}

// A prior on a pose, a motion and the time offset, and a problem that contains them in another
// order.
class MarginalizationPriorTest : public ::testing::Test {
 protected:
  static constexpr BlockId kPose{BlockKind::kPose, 5}, kMotion{BlockKind::kMotion, 5},
      kTimeOffset{BlockKind::kTimeOffset, 0}, kOther{BlockKind::kMotion, 6};
  static constexpr int kSize = 16;

  MarginalizationPriorTest() {
    simulator::Random random(1);
    testing::Disturb(1.0, &random, &state_);
    std::vector<MarginalizationPrior::Block> blocks(3);
    blocks[0] = {kPose, 0, {}};
    std::copy(state_.pose.begin(), state_.pose.end(), blocks[0].linearization.begin());
    blocks[1] = {kMotion, 6, state_.motion};
    blocks[2] = {kTimeOffset, 15, {td_}};
    MatrixXd J(30, kSize);
    for (int i = 0; i < J.size(); ++i) J.data()[i] = random.Normal();
    const VectorXd b = testing::NormalVector(kSize, &random);
    prior_ = MarginalizationPrior(blocks, {J.transpose() * J, b});
    problem_.AddVariable(kOther, other_.data());
    problem_.AddVariable(kTimeOffset, &td_);
    problem_.AddVariable(kMotion, state_.motion.data());
    problem_.AddVariable(kPose, state_.pose.data());
  }

  // Moves the variables by `delta`, in the order of the prior.
  void Move(const VectorXd& delta) {
    PosePlus(state_.pose.data(), delta.data(), state_.pose.data());
    for (int i = 0; i < 9; ++i) state_.motion[i] += delta[6 + i];
    td_ += delta[15];
  }

  FrameState state_;
  std::array<double, 9> other_ = {};
  double td_ = 0.01;
  MarginalizationPrior prior_;
  WindowProblem problem_;
  // Dense rows by variable of the problem: pose first, then time offset, other, motion.
  const std::vector<int> dense_offset_ = {7, 6, 16, 0};
  static constexpr int kDenseSize = 25;
};

TEST_F(MarginalizationPriorTest, KeepsItsLinearizationPoints) {
  const double x = state_.position().x();
  Move(VectorXd::Ones(kSize));
  ASSERT_NE(prior_.Linearization(kPose), nullptr);
  EXPECT_EQ(prior_.Linearization(kPose)[0], x);
  EXPECT_EQ(prior_.Linearization(kTimeOffset)[0], 0.01);
  EXPECT_EQ(prior_.Linearization(kOther), nullptr);
}

TEST_F(MarginalizationPriorTest, CostIsTheQuadraticOfTheDistance) {
  EXPECT_NEAR(prior_.Cost(problem_), 0, 1e-12);
  simulator::Random random(2);
  const VectorXd delta = 0.3 * testing::NormalVector(kSize, &random);
  Move(delta);
  const Quadratic& q = prior_.quadratic();
  EXPECT_NEAR(prior_.Cost(problem_), 0.5 * delta.dot(q.H * delta) + q.b.dot(delta), 1e-9);
}

TEST_F(MarginalizationPriorTest, AddsGradientAndInformationWhereTheVariablesAre) {
  simulator::Random random(3);
  const VectorXd delta = 0.3 * testing::NormalVector(kSize, &random);
  Move(delta);
  MatrixXd H = MatrixXd::Zero(kDenseSize, kDenseSize);
  VectorXd b = VectorXd::Zero(kDenseSize);
  EXPECT_NEAR(prior_.AddTo(problem_, dense_offset_, &H, &b), prior_.Cost(problem_), 1e-12);

  MatrixXd S = MatrixXd::Zero(kSize, kDenseSize);  // dense order to prior order
  S.block<6, 6>(0, 0).setIdentity();
  S.block<9, 9>(6, 16).setIdentity();
  S(15, 6) = 1;
  const Quadratic& q = prior_.quadratic();
  EXPECT_MATRIX_NEAR(b, S.transpose() * (q.H * delta + q.b), 1e-9);
  const MatrixXd full = H.selfadjointView<Eigen::Upper>();
  EXPECT_MATRIX_NEAR(full, S.transpose() * q.H * S, 1e-12);
  EXPECT_TRUE(H.triangularView<Eigen::StrictlyLower>().toDenseMatrix().isZero(0));
}

TEST_F(MarginalizationPriorTest, ConstantsAreHeldFixed) {
  Move(VectorXd::Constant(kSize, 0.1));
  std::vector<int> dense_offset = dense_offset_;
  dense_offset[1] = -1;  // time offset
  MatrixXd H = MatrixXd::Zero(kDenseSize, kDenseSize), all_H = H;
  VectorXd b = VectorXd::Zero(kDenseSize), all_b = b;
  const double cost = prior_.AddTo(problem_, dense_offset, &H, &b);
  EXPECT_NEAR(cost, prior_.AddTo(problem_, dense_offset_, &all_H, &all_b), 1e-12);
  all_H.row(6).setZero();
  all_H.col(6).setZero();
  all_b[6] = 0;
  EXPECT_MATRIX_NEAR(H, all_H, 1e-12);
  EXPECT_MATRIX_NEAR(b, all_b, 1e-12);
}

TEST_F(MarginalizationPriorTest, MarginalizingKeepsTheSolutionOfTheRest) {
  const auto is_motion = [](const BlockId& id) { return id.kind == BlockKind::kMotion; };
  const MarginalizationPrior kept = prior_.Marginalize(is_motion);
  ASSERT_EQ(kept.blocks().size(), 2u);
  EXPECT_EQ(kept.Linearization(kMotion), nullptr);
  EXPECT_EQ(kept.Linearization(kPose)[1], prior_.Linearization(kPose)[1]);
  const VectorXd all = -prior_.quadratic().H.ldlt().solve(prior_.quadratic().b);
  const VectorXd rest = -kept.quadratic().H.ldlt().solve(kept.quadratic().b);
  VectorXd expected(7);
  expected << all.head(6), all[15];
  EXPECT_MATRIX_NEAR(rest, expected, 1e-10);
}

TEST_F(MarginalizationPriorTest, MarginalizingNothingOrAll) {
  const auto none = [](const BlockId&) { return false; };
  const auto all = [](const BlockId&) { return true; };
  EXPECT_MATRIX_NEAR(prior_.Marginalize(none).quadratic().H, prior_.quadratic().H, 0.0);
  const MarginalizationPrior empty = prior_.Marginalize(all);
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(empty.Cost(problem_), 0);
}

TEST_F(MarginalizationPriorTest, EmptyPriorHasNoInformation) {
  const MarginalizationPrior none;
  MatrixXd H = MatrixXd::Zero(kDenseSize, kDenseSize);
  VectorXd b = VectorXd::Zero(kDenseSize);
  EXPECT_EQ(none.AddTo(problem_, dense_offset_, &H, &b), 0);
  EXPECT_TRUE(H.isZero(0) && b.isZero(0));
  EXPECT_EQ(none.Linearization(kPose), nullptr);
}

}  // namespace

}  // namespace plm_vins
