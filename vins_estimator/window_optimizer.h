// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/merging/line_structure.h"
#include "vins_estimator/monitoring/imu_agreement.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/uncertainty/feature_noise.h"
#include "vins_estimator/uncertainty/imu_noise_learning.h"
#include "vins_estimator/uncertainty/rig_monitor.h"

namespace plm_vins {

// The estimate in the window, and how it follows from the measurements: places the newest frame,
// optimizes the window where that is not sufficient, and learns noise and outliers from the result.
class WindowOptimizer {
 public:
  // Both arguments must outlive this object.
  WindowOptimizer(const Config& config, const EstimatorOptions& options);

  // Result of solving for the newest frame.
  struct Solution {
    bool exists = false;                                 // the equations had a solution
    std::optional<Matrix15d> covariance = std::nullopt;  // covariance of the newest state
    double milliseconds = 0;                             // time to solve
  };

  // Result of all stages of one image that change the estimate.
  struct Step {
    // Replaces the solution by a later one.
    void Take(const Solution& later) {
      solution = later;
      timings.optimization += later.milliseconds;
    }

    Solution solution;
    LineTriangulationCounts triangulation;
    UnitedLines lines;
    bool imu_doubted = false;
    EstimatorCounts counts;
    EstimatorTimings timings;
  };

  const WindowEstimate& estimate() const { return estimate_; }
  WindowEstimate* mutable_estimate() { return &estimate_; }

  // Adds the newest frame and returns its state, propagated by the IMU alone.
  FrameState AddFrame(const FrameMeasurement& measurement);
  // The image with this timestamp becomes the newest keyframe.
  void BeginKeyframe(int64_t t_ns) { keyframe_ = {t_ns}; }

  // Optimizes the initial frames.
  Step SolveFirst();
  // Places the newest frame and, if that is not sufficient, optimizes the window. `was_blind`: the
  // previous frames have no known landmarks.
  Step Solve(bool keep_second_newest, bool was_blind);

  bool WindowIsFull() const;
  // Returns the problem's options with the current Manhattan frame and noise.
  ProblemOptions CurrentProblem(JacobiansAt jacobians_at) const;
  // Sets map, calibration, noise and faults.
  void Describe(EstimatorOutput* output) const;

 private:
  // The newest keyframe.
  struct Keyframe {
    int64_t t_ns = 0;
    std::optional<Matrix15d> covariance = std::nullopt;  // set once optimized with the window
  };

  Solution PlaceNewest();
  bool Suffices(const Solution& placement) const;
  double FindBack();  // returns the time it takes [ms]
  Solution SolveWindow(const SolverOptions& options);
  LineTriangulationCounts Triangulate();
  UnitedLines FindStructure(bool keep_second_newest);
  // If the IMU contradicts the solution: re-weights the newest interval and returns true.
  bool DoubtsNewestInterval();
  EstimatorCounts CountLandmarks() const;
  EstimatorCounts LearnFromWindow();
  PointMap::Fit FitOfNewest(int64_t keyframe_ns) const;
  const SolverOptions& CurrentSolution() const;

  const Config* config_;
  const EstimatorOptions* options_;
  bool is_first_ = false;  // the initial frames are being optimized
  WindowEstimate estimate_;
  LineStructure structure_;
  FeatureNoise noise_;
  RigMonitor rig_monitor_;
  DepthFaults depth_faults_;
  ImuNoiseLearning imu_noise_;
  ImuAgreement imu_agreement_;
  Keyframe keyframe_;
};

}  // namespace plm_vins
