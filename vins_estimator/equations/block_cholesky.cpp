// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/block_cholesky.h"

#include "common/geometry/small_cholesky.h"

namespace plm_vins {
namespace {

// Returns the rows of `columns` that are not zero.
template <typename Columns>
std::vector<ColumnRun> RunsOf(const Columns& columns) {
  std::vector<ColumnRun> runs;
  for (int i = 0; i < columns.rows(); ++i) {
    if ((columns.row(i).array() != 0).any()) AppendColumns(i, 1, &runs);
  }
  return runs;
}

}  // namespace

BlockCholesky::BlockCholesky(int sparse, Eigen::MatrixXd* S) {
  const auto dense = S->rows() - sparse;
  blocks_.reserve(sparse / kBlockSize);
  for (auto offset = S->rows() - kBlockSize; offset >= dense; offset -= kBlockSize) {
    if (!Eliminate(static_cast<int>(offset), S)) return;
  }
  dense_.compute(S->topLeftCorner(dense, dense));
  success_ = dense_.info() == Eigen::Success;
}

bool BlockCholesky::Eliminate(int offset, Eigen::MatrixXd* S) {
  Block block;
  block.offset = offset;
  const auto columns = S->block<Eigen::Dynamic, kBlockSize>(0, offset, offset, kBlockSize);
  block.runs = RunsOf(columns);
  for (int j = 0; j < kBlockSize; ++j) {
    for (int i = j; i < kBlockSize; ++i) block.L(i, j) = (*S)(offset + j, offset + i);
  }
  if (!FactorizeCholesky(&block.L)) return false;
  block.W.resize(kBlockSize, CountColumns(block.runs));
  for (const ColumnRun& run : block.runs) {
    block.W.middleCols(run.local, run.size) = columns.middleRows(run.dense, run.size).transpose();
  }
  if (!block.runs.empty()) {  // solveInPlace accesses the first element
    block.L.triangularView<Eigen::Lower>().solveInPlace(block.W);
    SubtractGram(block.W, block.runs, S);
  }
  blocks_.push_back(std::move(block));
  return true;
}

template <typename Matrix>
void BlockCholesky::SolveHalf(Matrix* x) const {
  for (const Block& block : blocks_) {
    auto own = x->template middleRows<kBlockSize>(block.offset);
    block.L.triangularView<Eigen::Lower>().solveInPlace(own);
    for (const ColumnRun& run : block.runs) {
      x->middleRows(run.dense, run.size).noalias() -=
          block.W.middleCols(run.local, run.size).transpose() * own;
    }
  }
  auto rest = x->topRows(dense_.rows());
  dense_.matrixL().solveInPlace(rest);
}

Eigen::VectorXd BlockCholesky::Solve(Eigen::VectorXd b) const {
  SolveHalf(&b);
  auto rest = b.head(dense_.rows());
  dense_.matrixU().solveInPlace(rest);
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    auto own = b.segment<kBlockSize>(block->offset);
    for (const ColumnRun& run : block->runs) {
      own.noalias() -= block->W.middleCols(run.local, run.size) * b.segment(run.dense, run.size);
    }
    block->L.transpose().triangularView<Eigen::Upper>().solveInPlace(own);
  }
  return b;
}

Eigen::MatrixXd BlockCholesky::InverseBlock(const std::vector<int>& rows) const {
  const int size = blocks_.empty() ? dense_.rows() : blocks_.front().offset + kBlockSize;
  Eigen::MatrixXd selection = Eigen::MatrixXd::Zero(size, rows.size());
  for (size_t i = 0; i < rows.size(); ++i) selection(rows[i], i) = 1;
  SolveHalf(&selection);
  return selection.transpose() * selection;
}

}  // namespace plm_vins
