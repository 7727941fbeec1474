// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/monitoring/camera_monitor.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Judges all cameras but the first, and weights their observations by that.
class RigMonitor {
 public:
  // `options` have the configured noise; `focal_length` is that of the first camera [px].
  RigMonitor(const ProblemOptions& options, double focal_length);

  // Drops observations by cameras that do not fit, before they triangulate landmarks of others.
  void DropUnfit(LocalMap* map) const;

  // Adds the residuals of an optimized window and removes outliers. Returns the counts of point
  // observations by other cameras than the host's.
  DepthCounts Judge(LocalMap* map);

  // Compares the baselines with the IMU, given the window's equations at their last linearization.
  void JudgeBaselines(const SlidingWindow& window, NormalEquations* equations);

  // Lowers the weights of cameras with more noise.
  void SetWeights(int64_t newest_ns, ProblemOptions* options) const;

  std::vector<CameraFaults> Faults() const;

 private:
  double focal_length_;
  std::vector<ProblemCamera> cameras_;
  std::vector<ExtrinsicsLink> links_;
  std::vector<CameraMonitor> monitors_;                         // of all cameras but the first
  std::vector<std::optional<LengthEvidence>> baseline_errors_;  // in the same order
};

}  // namespace plm_vins
