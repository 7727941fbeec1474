// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/geometry/timed_bearing.h"

namespace plm_vins {

// A corner's factor, PointFactor or PointHostFactor, with the read-out time of a rolling shutter as
// one more variable: the factor at the time offset td + Delay(readout). Blocks: those of the
// factor, read-out time (1).
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
