// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "vins_estimator/equations/gram.h"

namespace plm_vins {

// Cholesky factorization of a symmetric positive definite matrix whose last variables form blocks
// coupled to few others. These blocks are eliminated first, from the last to the first, using only
// their nonzero columns; the remainder is factorized as a dense matrix.
class BlockCholesky {
 public:
  static constexpr int kBlockSize = 9;

  // Factorizes S in place, using its upper triangle only. `sparse` is the number of trailing
  // variables that form blocks, a multiple of kBlockSize.
  BlockCholesky(int sparse, Eigen::MatrixXd* S);

  // Returns whether S is positive definite; if not, the functions below must not be called.
  bool success() const { return success_; }

  // Returns S^-1 b.
  Eigen::VectorXd Solve(Eigen::VectorXd b) const;

  // Returns the given rows and columns of S^-1.
  Eigen::MatrixXd InverseBlock(const std::vector<int>& rows) const;

 private:
  using Matrix9d = Eigen::Matrix<double, kBlockSize, kBlockSize>;

  struct Block {
    int offset = 0;
    Matrix9d L;                   // Cholesky factor of the diagonal block, lower triangle
    std::vector<ColumnRun> runs;  // columns of the coupled variables
    Rows<kBlockSize> W;           // L^-1 times the block's rows, over the runs
  };

  bool Eliminate(int offset, Eigen::MatrixXd* S);
  // Forward substitution: replaces x by y such that x^T S^-1 x = y^T y.
  template <typename Matrix>
  void SolveHalf(Matrix* x) const;

  std::vector<Block> blocks_;  // in elimination order
  Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> dense_;
  bool success_ = false;
};

}  // namespace plm_vins
