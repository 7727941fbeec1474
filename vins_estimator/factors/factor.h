// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// A residual as a function of several variable blocks, with Jacobians as defined in
// factors/manifolds.h. It is a ceres::CostFunction without the list of block sizes: allocating that
// list for each observation of the window would take longer than the evaluation. Factors are never
// destroyed (trivial destructors).
class Factor {
 public:
  int num_residuals() const { return num_residuals_; }
  int num_blocks() const { return num_blocks_; }

  // Same contract as ceres::CostFunction::Evaluate().
  virtual bool Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const = 0;

 protected:
  Factor(int num_residuals, int num_blocks)
      : num_residuals_(num_residuals), num_blocks_(num_blocks) {}
  ~Factor() = default;
  Factor(const Factor&) = default;
  Factor& operator=(const Factor&) = default;

 private:
  int num_residuals_, num_blocks_;
};

// A factor with block sizes known at compile time.
template <int kResiduals, int... kSizes>
class SizedFactor : public Factor {
 protected:
  SizedFactor() : Factor(kResiduals, sizeof...(kSizes)) {}
};

}  // namespace plm_vins
