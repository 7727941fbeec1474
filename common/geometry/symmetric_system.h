// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace plm_vins {

// Up to 12 rows and columns, without heap memory.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;

// Returns A^-1 B for a symmetric, positive or negative semidefinite A. Eigen's LDLT takes a
// compiler seconds for each size in every source that uses it, so that of SmallMatrix solves all.
SmallMatrix SolveSmallSymmetric(const SmallMatrix& A, const SmallMatrix& B);

// Returns L^-1 of A = L L^T; nullopt if A is not positive definite.
std::optional<Eigen::MatrixXd> InverseCholeskyFactor(const Eigen::MatrixXd& A);

// Returns A^-1 B like SolveSmallSymmetric(), with fixed sizes.
template <int kSize, int kColumns>
Eigen::Matrix<double, kSize, kColumns> SolveSymmetric(
    const Eigen::Matrix<double, kSize, kSize>& A, const Eigen::Matrix<double, kSize, kColumns>& B) {
  static_assert(kSize <= 12 && kColumns <= 12);
  return SolveSmallSymmetric(A, B);
}

template <int kSize>
Eigen::Matrix<double, kSize, kSize> InverseOfSymmetric(
    const Eigen::Matrix<double, kSize, kSize>& A) {
  return SolveSymmetric<kSize, kSize>(A, Eigen::Matrix<double, kSize, kSize>::Identity());
}

}  // namespace plm_vins
