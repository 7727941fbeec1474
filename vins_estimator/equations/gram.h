// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plm_vins {

// Adjacent columns of a narrow matrix that are adjacent in a wide matrix as well.
struct ColumnRun {
  int local = 0;
  int dense = 0;
  int size = 0;
};

inline int CountColumns(const std::vector<ColumnRun>& runs) {
  return runs.empty() ? 0 : runs.back().local + runs.back().size;
}

// Appends `size` columns of the wide matrix, starting at `dense`.
inline void AppendColumns(int dense, int size, std::vector<ColumnRun>* runs) {
  const bool continues = !runs->empty() && runs->back().dense + runs->back().size == dense;
  if (!continues) runs->push_back({CountColumns(*runs), dense, 0});
  runs->back().size += size;
}

// Rows over the columns of a few runs, row-major.
template <int kRows>
using Rows = Eigen::Matrix<double, kRows, Eigen::Dynamic, Eigen::RowMajor>;

// Computes S -= W^T W in the upper triangle of S. W is of type Rows, or a map of it, and its
// columns belong to the columns `runs` of S.
template <typename RowsOfW>
void SubtractGram(const RowsOfW& W, const std::vector<ColumnRun>& runs, Eigen::MatrixXd* S) {
  constexpr int kRows = RowsOfW::RowsAtCompileTime;
  for (auto right = runs.begin(); right != runs.end(); ++right) {
    for (int j = 0; j < right->size; ++j) {
      const Eigen::Matrix<double, kRows, 1> factor = W.col(right->local + j);
      for (auto left = runs.begin(); left <= right; ++left) {
        const int size = left == right ? j + 1 : left->size;
        const double* __restrict__ row = W.data() + left->local;
        double* __restrict__ target = &(*S)(left->dense, right->dense + j);
        for (int i = 0; i < size; ++i) {
          double sum = 0;
          for (int l = 0; l < kRows; ++l) sum += factor[l] * row[l * W.cols() + i];
          target[i] -= sum;
        }
      }
    }
  }
}

}  // namespace plm_vins
