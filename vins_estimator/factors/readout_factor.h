// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// Extends a corner's factor (PointFactor or PointHostFactor) by the readout time of a rolling
// shutter as a variable: evaluates it at the time offset td + Delay(readout). Blocks: those of the
// inner factor, readout time (1).
template <typename Inner>
class ReadoutFactor final : public Factor {
 public:
  static constexpr int kBlocks = Inner::kBlocks + 1;

  ReadoutFactor(const Inner& factor, const TimedBearing& bearing);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Inner factor_;
  TimedBearing bearing_;
};

}  // namespace plm_vins
