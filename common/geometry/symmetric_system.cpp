// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_system.h"

#include <Eigen/Cholesky>

namespace plm_vins {

template <int kSize>
Eigen::Matrix<double, kSize, 1> SolveSymmetric(const Eigen::Matrix<double, kSize, kSize>& A,
                                               const Eigen::Matrix<double, kSize, 1>& b) {
  return A.ldlt().solve(b);
}

template Eigen::Matrix<double, 3, 1> SolveSymmetric(const Eigen::Matrix<double, 3, 3>& A,
                                                    const Eigen::Matrix<double, 3, 1>& b);
template Eigen::Matrix<double, 5, 1> SolveSymmetric(const Eigen::Matrix<double, 5, 5>& A,
                                                    const Eigen::Matrix<double, 5, 1>& b);
template Eigen::Matrix<double, 6, 1> SolveSymmetric(const Eigen::Matrix<double, 6, 6>& A,
                                                    const Eigen::Matrix<double, 6, 1>& b);

}  // namespace plm_vins
