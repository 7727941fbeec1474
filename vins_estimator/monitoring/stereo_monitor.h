// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {

// Judges the second camera by its residuals after each optimization: the noise of its observations,
// whether its mounting and intrinsics fit, and the delay of its exposure. Lines are used only while
// points fit, because edges of another scene match by chance more easily.
class StereoMonitor {
 public:
  // `point_noise`: standard deviation of a corner in the first camera, normalized.
  explicit StereoMonitor(double point_noise) : least_noise_(point_noise), noise_(point_noise) {}

  // Adds the residuals of an optimized window, and drops the outliers among its observations in the
  // second camera. Returns the counts of point observations.
  DepthCounts Judge(const SlidingWindow& window, PointMap* points, LineMap* lines);

  // Adds the residuals of an optimized window; `t_ns` is the timestamp of its newest image.
  void Add(int64_t t_ns, const std::vector<RightResidual>& residuals);
  void Add(int64_t t_ns, const std::vector<RightLineResidual>& residuals);

  // Standard deviation of a corner in the second camera, normalized. It is large if the camera does
  // not fit, so that its observations have no weight.
  double noise() const;
  // Residual above which a single observation is an outlier.
  double max_error() const;

  // Returns whether lines in the second camera are used in the image with the timestamp `t_ns`:
  // lines fit, and so do recent points.
  bool UsesLines(int64_t t_ns) const;
  // Factor on the stated standard deviations of lines; large if lines are not used.
  double line_noise_factor(int64_t t_ns) const;

  // Median residual, normalized, if it is too large for the second camera to be used; otherwise
  // nullopt.
  std::optional<double> misfit() const;
  // Time by which the second camera exposes later than the first [s]; nullopt if it is not
  // significant.
  std::optional<double> delay() const;

 private:
  double least_noise_;
  double noise_;
  double line_noise_factor_ = 1;
  std::optional<int64_t> newest_ns_, newest_line_ns_;
  double flow_by_residual_ = 0, flow_squared_ = 0;  // forgetting sums, for the delay
};

}  // namespace plm_vins
