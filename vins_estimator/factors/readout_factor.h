// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <cstddef>
#include <memory>

#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// A corner's factor with the read-out time of a rolling shutter as one more variable: the factor at
// the time offset td + Delay(readout). Blocks: those of the factor, read-out time (1).
class ReadoutFactor final : public ceres::CostFunction {
 public:
  // `td_block`: which block of `factor` is td.
  ReadoutFactor(std::unique_ptr<ceres::CostFunction> factor, size_t td_block,
                const TimedBearing& bearing);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::unique_ptr<ceres::CostFunction> factor_;
  size_t td_block_;
  TimedBearing bearing_;
};

}  // namespace plm_vins
