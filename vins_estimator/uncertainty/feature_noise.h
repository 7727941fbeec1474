// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/local_map.h"
#include "vins_estimator/uncertainty/residual_spread.h"

namespace plm_vins {

// Returns the standard deviation at which independent observations would carry as much information
// as the given ones; nullopt for too few landmarks. Errors along a track are correlated: a template
// drifts, an outline shifts with the viewpoint. With the correlation of consecutive errors, rho = 1
// - difference / variance, n observations are worth n (1 - rho) / (1 + rho) independent ones
// (first-order autoregression, [Bayley1946]). Outlier landmarks are clipped to three times the
// median standard deviation.
std::optional<double> EffectiveNoise(const std::vector<ResidualSpread>& spreads);

// Estimates the noise of corners and line end points from the residuals of the optimized window,
// because texture, blur, compression and calibration make it differ between cameras. Adapts slowly
// and within bounds, so that no single window determines its own weight.
class FeatureNoise {
 public:
  // Takes the configured noise, normalized.
  FeatureNoise(double point_noise, double line_noise)
      : first_point_(point_noise),
        first_line_(line_noise),
        point_(first_point_),
        line_(first_line_) {}

  // Updates the estimate from a window that was just optimized. Ignores windows with little motion,
  // in which errors are the same in all observations.
  void Update(const LocalMap& map);

  double point() const { return point_; }
  double line() const { return line_; }

 private:
  double first_point_, first_line_;
  double point_, line_;
  std::optional<int64_t> newest_ns_;  // newest image of the last window
};

}  // namespace plm_vins
