// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace plm_vins {

// Replaces the lower triangle of a symmetric matrix by its Cholesky factor L, with L L^T equal to
// the matrix. Returns false if the matrix is not positive definite. Plain loops, since Eigen's LLT
// takes a compiler seconds for each size; the result has the same bits.
template <int kSize>
bool FactorizeCholesky(Eigen::Matrix<double, kSize, kSize>* matrix) {
  auto& L = *matrix;
  const auto sum_of_products = [&L](int i, int k) {
    double sum = 0;
    for (int j = 0; j < k; ++j) sum += L(i, j) * L(k, j);
    return sum;
  };
  for (int k = 0; k < kSize; ++k) {
    const double square = L(k, k) - sum_of_products(k, k);
    if (square <= 0) return false;
    L(k, k) = std::sqrt(square);
    for (int i = k + 1; i < kSize; ++i) L(i, k) = (L(i, k) - sum_of_products(i, k)) / L(k, k);
  }
  return true;
}

// Returns (L L^T)^-1 X. Only the lower triangle of L is read.
template <int kSize, typename Matrix>
Matrix SolveByCholesky(const Eigen::Matrix<double, kSize, kSize>& L, Matrix X) {
  L.template triangularView<Eigen::Lower>().solveInPlace(X);
  L.transpose().template triangularView<Eigen::Upper>().solveInPlace(X);
  return X;
}

}  // namespace plm_vins
