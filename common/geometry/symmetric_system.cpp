// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_system.h"

#include <Eigen/Cholesky>

namespace plm_vins {

using Eigen::Matrix;

template <int kSize, int kColumns>
Matrix<double, kSize, kColumns> SolveSymmetric(const Matrix<double, kSize, kSize>& A,
                                               const Matrix<double, kSize, kColumns>& B) {
  return A.ldlt().solve(B);
}

template Matrix<double, 3, 1> SolveSymmetric(const Matrix<double, 3, 3>&,
                                             const Matrix<double, 3, 1>&);
template Matrix<double, 3, 3> SolveSymmetric(const Matrix<double, 3, 3>&,
                                             const Matrix<double, 3, 3>&);
template Matrix<double, 4, 1> SolveSymmetric(const Matrix<double, 4, 4>&,
                                             const Matrix<double, 4, 1>&);
template Matrix<double, 4, 4> SolveSymmetric(const Matrix<double, 4, 4>&,
                                             const Matrix<double, 4, 4>&);
template Matrix<double, 5, 1> SolveSymmetric(const Matrix<double, 5, 5>&,
                                             const Matrix<double, 5, 1>&);
template Matrix<double, 6, 1> SolveSymmetric(const Matrix<double, 6, 6>&,
                                             const Matrix<double, 6, 1>&);
template Matrix<double, 6, 6> SolveSymmetric(const Matrix<double, 6, 6>&,
                                             const Matrix<double, 6, 6>&);

}  // namespace plm_vins
