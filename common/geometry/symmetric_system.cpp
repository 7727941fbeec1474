// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_system.h"

#include <Eigen/Cholesky>

namespace plm_vins {

SmallMatrix SolveSmallSymmetric(const SmallMatrix& A, const SmallMatrix& B) {
  return A.ldlt().solve(B);
}

std::optional<Eigen::MatrixXd> InverseCholeskyFactor(const Eigen::MatrixXd& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.matrixL().solve(Eigen::MatrixXd::Identity(A.rows(), A.cols()));
}

}  // namespace plm_vins
