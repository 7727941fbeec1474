// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/marginalization_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
