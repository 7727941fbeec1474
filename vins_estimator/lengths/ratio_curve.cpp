// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/ratio_curve.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {

void RatioCurve::Add(const RatioCurve& other, double weight) {
  for (int i = 0; i < kPoints; ++i) {
    likelihood_[i] += weight * other.likelihood_[i];
    half_chi_square_[i] += weight * other.half_chi_square_[i];
  }
}

RatioEstimate RatioCurve::Estimate(double model_deviation) const {
  const auto best = std::max_element(likelihood_.begin(), likelihood_.end());
  RatioEstimate estimate;
  if (best == likelihood_.begin() || best + 1 == likelihood_.end()) return estimate;
  const double slope = 0.5 * (best[1] - best[-1]);
  const double curvature = 2 * best[0] - best[1] - best[-1];
  if (!(curvature > 0)) return estimate;
  const auto index = best - likelihood_.begin();
  estimate.log_ratio = LogRatio(static_cast<int>(index)) + kStep * slope / curvature;
  estimate.deviation = std::hypot(kStep / std::sqrt(curvature), model_deviation);
  const double more_likely = *best - likelihood_[kHalf];
  const double better_fit = std::max(0.0, half_chi_square_[kHalf] - half_chi_square_[index]);
  estimate.contradiction = std::min(std::abs(estimate.log_ratio) / estimate.deviation,
                                    std::sqrt(2 * std::min(more_likely, better_fit)));
  return estimate;
}

}  // namespace plm_vins
