// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "vins_estimator/equations/window_problem.h"

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

// Information on the window's variables from everything that was marginalized, as a quadratic
//   0.5 delta^T H delta + b^T delta,   delta = x [-] x0,
// about fixed linearization points x0. A variable keeps its x0 as long as it is in the prior, and
// what is marginalized later is linearized at x0, too (first-estimate Jacobians), so that the
// unobservable directions, position and heading, gain no spurious information ([Huang2010]). The
// solution and the published covariance are linearized at the current values (JacobiansAt).
class MarginalizationPrior {
 public:
  struct Block {
    BlockId id;
    int offset = 0;  // first row in H
    std::array<double, kMaxAmbientSize> linearization = {};
  };

  // Returns a block that is linearized at `values`.
  static Block MakeBlock(const BlockId& id, int offset, const double* values);

  MarginalizationPrior() = default;
  MarginalizationPrior(std::vector<Block> blocks, Quadratic quadratic)
      : blocks_(std::move(blocks)), quadratic_(std::move(quadratic)) {}

  bool empty() const { return blocks_.empty(); }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Quadratic& quadratic() const { return quadratic_; }

  // Returns the linearization point of a variable, or null if it is not in the prior.
  const double* Linearization(const BlockId& id) const;

  // Returns the value of the quadratic at the problem's values, up to a constant.
  double Cost(const WindowProblem& problem) const;

  // Adds the quadratic to dense equations (upper triangle of H); returns Cost(). `dense_offset` is
  // the first dense row by variable index, -1 for constants, which are held fixed.
  double AddTo(const WindowProblem& problem, const std::vector<int>& dense_offset,
               Eigen::MatrixXd* H, Eigen::VectorXd* b) const;

  // Returns the prior with the variables that `drop` selects marginalized.
  MarginalizationPrior Marginalize(const std::function<bool(const BlockId&)>& drop) const;

 private:
  Eigen::VectorXd Delta(const WindowProblem& problem) const;

  std::vector<Block> blocks_;
  Quadratic quadratic_;
};

}  // namespace plm_vins
