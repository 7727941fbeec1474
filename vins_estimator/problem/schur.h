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

// Minimises over the first `count` components of x: the quadratic of what remains,
//   H' = H_rr - H_rm H_mm^-1 H_mr,  b' = b_r - H_rm H_mm^-1 b_m.
// Pivots of H_mm that are zero drop out; right-hand sides are in the range of H_mm, as of every sum
// of squares, so directions without information do no harm.
Quadratic MarginalizeFirst(const Quadratic& quadratic, int count);

// The same quadratic with component i moved to position new_position[i].
Quadratic Permute(const Quadratic& quadratic, const std::vector<int>& new_position);

}  // namespace plm_vins
