// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/point_map.h"

namespace plm_vins {

// Judges the second camera by its residuals after each optimization: how noisy its observations
// are, whether it fits its mounting and intrinsics at all, and whether it exposes late.
class StereoMonitor {
 public:
  // `point_noise`: standard deviation of a corner in the first camera, normalized.
  explicit StereoMonitor(double point_noise) : least_noise_(point_noise), noise_(point_noise) {}

  // Adds the residuals of an optimized window, and drops the outliers among its observations in the
  // second camera. Counts both.
  DepthCounts Judge(const SlidingWindow& window, PointMap* points);

  // Adds the residuals of an optimized window, whose newest image is of `t_ns`.
  void Add(int64_t t_ns, const std::vector<RightResidual>& residuals);

  // Standard deviation of a corner in the second camera, normalized. It is large if the camera does
  // not fit, so that its observations have no weight.
  double noise() const;
  // Residual above which a single observation is an outlier.
  double max_error() const;

  // Median residual, normalized, if it is too large for the second camera to be used; otherwise
  // nullopt.
  std::optional<double> misfit() const;
  // Time by which the second camera exposes later than the first [s]; nullopt if it is not
  // significant.
  std::optional<double> delay() const;

 private:
  double least_noise_;
  double noise_;
  std::optional<int64_t> newest_ns_;
  double flow_by_residual_ = 0, flow_squared_ = 0;  // forgetting sums, for the delay
};

}  // namespace plm_vins
