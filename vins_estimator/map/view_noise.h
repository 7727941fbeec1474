// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/local_map.h"
#include "vins_estimator/map/view_spread.h"

namespace plm_vins {

// The standard deviation with which independent views would contain as much information as these.
// Errors of a track are not independent: a template drifts, an outline wanders with the viewpoint.
// The share that follows on from view to view, rho = 1 - difference / variance, makes n views worth
// n (1 - rho) / (1 + rho) independent ones (autoregression of first order, [Bayley1946]). Landmarks
// that stand out count as much as three times the median one. Nothing for too few landmarks.
std::optional<double> EffectiveNoise(const std::vector<ViewSpread>& spreads);

// Noise of corners and of lines' ends, as the optimised window shows it rather than as configured:
// texture, blur, compression and calibration make it differ from camera to camera. Follows slowly
// and within bounds, so that no single window decides on its own weight.
class ViewNoise {
 public:
  // What is assumed at first, normalised.
  ViewNoise(double point_noise, double line_noise)
      : first_point_(point_noise),
        first_line_(line_noise),
        point_(first_point_),
        line_(first_line_) {}

  // Learns from a window that was just optimised. Ignores windows of standing still or nearly so:
  // there, errors are the same in all views.
  void Update(const LocalMap& map);

  double point() const { return point_; }
  double line() const { return line_; }

 private:
  double first_point_, first_line_;
  double point_, line_;
  std::optional<int64_t> newest_ns_;  // of the last window
};

}  // namespace plm_vins
