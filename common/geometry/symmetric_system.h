// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// Returns A^-1 b for a symmetric, positive or negative semidefinite A. Eigen's LDLT of each size
// takes a compiler seconds in every source that uses it, so symmetric_system.cpp instantiates sizes
// 3, 5 and 6 for all.
template <int kSize>
Eigen::Matrix<double, kSize, 1> SolveSymmetric(const Eigen::Matrix<double, kSize, kSize>& A,
                                               const Eigen::Matrix<double, kSize, 1>& b);

}  // namespace plm_vins
