// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_system.h"

#include <Eigen/Cholesky>

namespace plm_vins {

SmallMatrix SolveSmallSymmetric(const SmallMatrix& A, const SmallMatrix& B) {
  return A.ldlt().solve(B);
}

}  // namespace plm_vins
