// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "vins_estimator/problem/gram.h"

namespace plm_vins {

// Cholesky factors of a symmetric, positive definite matrix, whose last variables come in blocks
// that know few others: they are eliminated first, from the last on, over the columns that are not
// zero. The rest is taken as dense.
class BlockCholesky {
 public:
  static constexpr int kBlockSize = 9;

  // Factors S, of which it reads and overwrites the upper triangle. `sparse`: how many of its last
  // variables are in blocks, a multiple of kBlockSize.
  BlockCholesky(int sparse, Eigen::MatrixXd* S);

  // S is positive definite; else nothing below has a meaning.
  bool success() const { return success_; }

  // S^-1 b.
  Eigen::VectorXd Solve(Eigen::VectorXd b) const;

  // These rows and columns of S^-1.
  Eigen::MatrixXd InverseBlock(const std::vector<int>& rows) const;

 private:
  using Matrix9d = Eigen::Matrix<double, kBlockSize, kBlockSize>;

  struct Block {
    int offset = 0;
    Eigen::LLT<Matrix9d> factor;  // L L^T of the block on the diagonal
    std::vector<ColumnRun> runs;  // the others that it knows
    Rows<kBlockSize> W;           // L^-1 of the block's rows over the runs
  };

  bool Eliminate(int offset, Eigen::MatrixXd* S);
  // Makes y of x, such that x^T S^-1 x = y^T y.
  template <typename Matrix>
  void SolveHalf(Matrix* x) const;

  std::vector<Block> blocks_;  // in the order of their elimination
  Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> dense_;
  bool success_ = false;
};

}  // namespace plm_vins
