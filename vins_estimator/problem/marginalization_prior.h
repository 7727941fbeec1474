// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "vins_estimator/problem/schur.h"
#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

// What is known of the window's variables from everything that left it, as a quadratic
//   0.5 delta^T H delta + b^T delta,   delta = x [-] x0,
// about fixed linearisation points x0. A variable keeps its x0 as long as the prior holds it, and
// what is marginalised later takes its Jacobians there as well, so that the unobservable directions
// (position and heading) gain no information they must not have ([Huang2010]). The solution and
// the covariance that is published take theirs at the values (JacobiansAt).
class MarginalizationPrior {
 public:
  struct Block {
    BlockId id;
    int offset = 0;  // first row in H
    std::array<double, kMaxAmbientSize> linearization = {};
  };

  // A block whose linearisation point is at `values`.
  static Block MakeBlock(const BlockId& id, int offset, const double* values);

  MarginalizationPrior() = default;
  MarginalizationPrior(std::vector<Block> blocks, Quadratic quadratic)
      : blocks_(std::move(blocks)), quadratic_(std::move(quadratic)) {}

  bool empty() const { return blocks_.empty(); }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Quadratic& quadratic() const { return quadratic_; }

  // Linearisation point of a variable, or null where the prior does not hold it.
  const double* Linearization(const BlockId& id) const;

  // Value of the quadratic (up to a constant) at the problem's values.
  double Cost(const WindowProblem& problem) const;

  // Adds the quadratic to dense equations (upper triangle of H); returns Cost().
  // `dense_offset`: first dense row by variable index, -1 for constants, which count as they are.
  double AddTo(const WindowProblem& problem, const std::vector<int>& dense_offset,
               Eigen::MatrixXd* H, Eigen::VectorXd* b) const;

  // The prior without the variables that `drop` selects, marginalised.
  MarginalizationPrior Marginalize(const std::function<bool(const BlockId&)>& drop) const;

 private:
  Eigen::VectorXd Delta(const WindowProblem& problem) const;

  std::vector<Block> blocks_;
  Quadratic quadratic_;
};

}  // namespace plm_vins
