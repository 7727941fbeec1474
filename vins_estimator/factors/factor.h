// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// A residual by some blocks of variables, with Jacobians as of factors/manifolds.h. What a
// ceres::CostFunction is, without its list of the blocks' sizes: to allocate one for each view of
// the window takes longer than to evaluate it. Nor is it ever destroyed. Each kind of factor says
// how many blocks it has: kBlocks.
class Factor {
 public:
  int num_residuals() const { return num_residuals_; }

  // As ceres::CostFunction::Evaluate().
  virtual bool Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const = 0;

 protected:
  explicit Factor(int num_residuals) : num_residuals_(num_residuals) {}
  ~Factor() = default;
  Factor(const Factor&) = default;
  Factor& operator=(const Factor&) = default;

 private:
  int num_residuals_;
};

// One whose blocks have these sizes.
template <int kResiduals, int... kSizes>
class SizedFactor : public Factor {
 public:
  static constexpr int kBlocks = sizeof...(kSizes);

 protected:
  SizedFactor() : Factor(kResiduals) {}
};

}  // namespace plm_vins
