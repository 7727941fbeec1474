// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plm_vins {

// The quadratic 0.5 x^T H x + b^T x, H symmetric positive semi-definite.
struct Quadratic {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

// Minimizes over the first `count` components of x and returns the quadratic of the remaining ones,
//   H' = H_rr - H_rm H_mm^-1 H_mr,  b' = b_r - H_rm H_mm^-1 b_m.
// Zero pivots of H_mm are skipped: b_m and H_mr are in the range of H_mm, as for every sum of
// squares, so directions without information have no effect.
Quadratic MarginalizeFirst(const Quadratic& quadratic, int count);

// Moves component i to position new_position[i].
Quadratic Permute(const Quadratic& quadratic, const std::vector<int>& new_position);

}  // namespace plm_vins
