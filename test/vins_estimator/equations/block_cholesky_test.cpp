// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

constexpr int kDense = 13, kBlocks = 4, kBlock = BlockCholesky::kBlockSize;
constexpr int kSize = kDense + kBlocks * kBlock;

// Adds random information on the variables of these columns.
void AddInformation(const std::vector<int>& columns, std::mt19937* random, Eigen::MatrixXd* S) {
  std::normal_distribution<double> normal;
  const auto size = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd J =
      Eigen::MatrixXd::NullaryExpr(size + 3, size, [&] { return normal(*random); });
  const Eigen::MatrixXd H = J.transpose() * J;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) (*S)(columns[i], columns[j]) += H(i, j);
  }
}

void Append(int offset, int size, std::vector<int>* columns) {
  for (int i = 0; i < size; ++i) columns->push_back(offset + i);
}

// Equations like those of a window: adjacent blocks are coupled with each other and with some dense
// variables, the first block with all dense ones; variables have very different scales.
Eigen::MatrixXd ChainOfBlocks() {
  std::mt19937 random(3);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(kSize, kSize);
  std::vector<int> first;
  Append(0, kDense + kBlock, &first);
  AddInformation(first, &random, &S);
  for (int block = 0; block + 1 < kBlocks; ++block) {
    std::vector<int> columns;
    Append(3 * block, 4, &columns);
    Append(kDense + block * kBlock, 2 * kBlock, &columns);
    AddInformation(columns, &random, &S);
  }
  Eigen::VectorXd scale(kSize);
  for (int i = 0; i < kSize; ++i) scale[i] = std::pow(10.0, i % 7 - 3);
  return scale.asDiagonal() * S * scale.asDiagonal();
}

TEST(BlockCholesky, Solves) {
  const Eigen::MatrixXd S = ChainOfBlocks();
  const Eigen::VectorXd x = S.diagonal().cwiseSqrt().cwiseInverse();
  for (const int blocks : {0, 1, kBlocks}) {
    Eigen::MatrixXd factored = S;
    const BlockCholesky factors(blocks * kBlock, &factored);
    ASSERT_TRUE(factors.success());
    const Eigen::VectorXd solution = factors.Solve(S * x);
    EXPECT_MATRIX_NEAR(solution.cwiseQuotient(x), Eigen::VectorXd::Ones(kSize), 1e-9);
  }
}

TEST(BlockCholesky, ReadsTheUpperTriangleOnly) {
  Eigen::MatrixXd upper = ChainOfBlocks().triangularView<Eigen::Upper>();
  Eigen::MatrixXd full = ChainOfBlocks();
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(kSize);
  const BlockCholesky of_upper(kBlocks * kBlock, &upper), of_full(kBlocks * kBlock, &full);
  EXPECT_EQ(of_upper.Solve(b), of_full.Solve(b));
}

TEST(BlockCholesky, GivesABlockOfTheInverseInTheOrderAsked) {
  Eigen::MatrixXd S = ChainOfBlocks();
  const Eigen::VectorXd scale = S.diagonal().cwiseSqrt();
  const Eigen::MatrixXd inverse =
      (scale.cwiseInverse().asDiagonal() * S * scale.cwiseInverse().asDiagonal()).inverse();
  const std::vector<int> rows = {kSize - 1, 2, kDense + 1};
  const Eigen::MatrixXd block = BlockCholesky(kBlocks * kBlock, &S).InverseBlock(rows);
  ASSERT_EQ(block.rows(), 3);
  ASSERT_EQ(block.cols(), 3);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const double scaled = block(i, j) * scale[rows[i]] * scale[rows[j]];
      EXPECT_NEAR(scaled, inverse(rows[i], rows[j]), 1e-9 * inverse.diagonal().maxCoeff());
    }
  }
}

TEST(BlockCholesky, AcceptsUncoupledBlocks) {
  Eigen::MatrixXd S = 4 * Eigen::MatrixXd::Identity(kSize, kSize);
  const BlockCholesky factors(kBlocks * kBlock, &S);
  EXPECT_EQ(factors.Solve(Eigen::VectorXd::Ones(kSize)), Eigen::VectorXd::Constant(kSize, 0.25));
}

TEST(BlockCholesky, DetectsIndefiniteMatrices) {
  for (const int wrong : {1, kDense + 2, kSize - 1}) {
    Eigen::MatrixXd S = ChainOfBlocks();
    S(wrong, wrong) *= -1;
    EXPECT_FALSE(BlockCholesky(kBlocks * kBlock, &S).success());
  }
}

}  // namespace
}  // namespace plm_vins
