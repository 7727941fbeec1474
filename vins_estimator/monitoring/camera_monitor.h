// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {

// Standard deviations of the observations in a camera, normalized.
struct CameraNoise {
  double point;  // of a corner
  double line;   // of an end point across its line, if the observation states none
};

// Judges a camera other than the first by its residuals after each optimization: the noise of its
// observations, whether its extrinsics and intrinsics fit, and the delay of its exposure. Lines are
// used only while points fit, because edges of another scene match by chance more easily.
class CameraMonitor {
 public:
  // `least` is the configured noise.
  CameraMonitor(int camera, const CameraNoise& least)
      : camera_(camera), least_(least), noise_(least.point) {}

  // Adds the residuals of an optimized window, and removes the outliers among the camera's
  // observations of landmarks that other cameras host. Returns the counts of point observations.
  DepthCounts Judge(const SlidingWindow& window, PointMap* points, LineMap* lines);

  // Adds the residuals of an optimized window; `t_ns` is the timestamp of its newest image.
  void Add(int64_t t_ns, const std::vector<PointResidual>& residuals);
  void Add(int64_t t_ns, const std::vector<LineResidual>& residuals);

  // Standard deviation of a corner, normalized. It is large if the camera does not fit, so that its
  // observations have no weight.
  double noise() const;

  // Returns whether lines are used in the image with the timestamp `t_ns`: lines fit, and so do
  // recent points.
  bool UsesLines(int64_t t_ns) const;
  // Factor on the standard deviations of lines; large if lines are not used.
  double line_noise_factor(int64_t t_ns) const;

  // Median residual, normalized, if it is too large for the camera to be used; otherwise nullopt.
  std::optional<double> misfit() const;
  // Time by which the camera exposes later than the first [s]; nullopt if it is not significant.
  std::optional<double> delay() const;

  int camera() const { return camera_; }

 private:
  int camera_;
  CameraNoise least_;
  double noise_;
  double line_noise_factor_ = 1;
  std::optional<int64_t> newest_ns_, newest_line_ns_;
  double flow_by_residual_ = 0, flow_squared_ = 0;  // forgetting sums, for the delay
};

}  // namespace plm_vins
