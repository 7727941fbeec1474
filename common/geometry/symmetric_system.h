// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// Returns A^-1 B for a symmetric, positive or negative semidefinite A. Eigen's LDLT of each size
// takes a compiler seconds in every source that uses it, so symmetric_system.cpp instantiates it
// for all: one column for sizes 3 to 6, as many columns as rows for sizes 3, 4 and 6.
template <int kSize, int kColumns>
Eigen::Matrix<double, kSize, kColumns> SolveSymmetric(
    const Eigen::Matrix<double, kSize, kSize>& A, const Eigen::Matrix<double, kSize, kColumns>& B);

template <int kSize>
Eigen::Matrix<double, kSize, kSize> InverseOfSymmetric(
    const Eigen::Matrix<double, kSize, kSize>& A) {
  return SolveSymmetric<kSize, kSize>(A, Eigen::Matrix<double, kSize, kSize>::Identity());
}

}  // namespace plm_vins
