// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/failure/estimate_monitor.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/map/pixel_residuals.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/merging/line_structure.h"
#include "vins_estimator/monitoring/imu_agreement.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/uncertainty/depth_evidence.h"
#include "vins_estimator/uncertainty/imu_noise_learning.h"
#include "vins_estimator/uncertainty/rig_monitor.h"
#include "vins_estimator/uncertainty/view_noise.h"

namespace plm_vins {

// Odometry in a sliding window, from initialization to loss: one call per image, one stage per line
// of Track().
class WindowOdometry {
 public:
  // Both arguments must outlive this object.
  WindowOdometry(const Config& config, const EstimatorOptions& options);

  // Result of one image.
  struct Tracked {
    FrameState newest;
    std::optional<Matrix15d> covariance;  // covariance of `newest`
    std::optional<Failure> failure;       // if set, tracking is lost: reinitialize
    EstimatorOutput output;               // only counts and timings if tracking is lost
    // Points in the middle frame of the window, whose pose is known best; each keyframe once. By
    // camera, or empty.
    std::vector<std::vector<PixelResidual>> residuals;
  };

  // Fills the window with the initial frames and optimizes it.
  EstimatorOutput Start(const InitializationResult& result, const InitialUncertainty& uncertainty);
  bool started() const { return started_; }

  // Median depth of the known points in the newest image [m]; nullopt if there are few, or if no
  // motion since the start can have told it: noise then places points arbitrarily near.
  std::optional<double> MedianDepth() const {
    if (!started_ || !depth_evidence_.is_known()) return std::nullopt;
    return estimate_.map.points.MedianDepthInNewest(estimate_.map.window);
  }

  // Processes the next image; requires started(). `features_observed` counts the features of the
  // image, even if they are not in the measurement because they are not to be used.
  Tracked Track(const FrameMeasurement& measurement,
                const std::optional<StandstillDetector::Standstill>& standstill,
                int features_observed);

  // The window with calibration and gravity; as configured before the start.
  const SlidingWindow& window() const { return estimate_.map.window; }

 private:
  // The newest keyframe.
  struct Keyframe {
    int64_t t_ns = 0;
    std::optional<Matrix15d> covariance = std::nullopt;  // set once optimized with the window
  };

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

  void Fill(const InitializationResult& result, const InitialUncertainty& uncertainty);
  Step SolveFirstWindow();
  // Adds the newest frame and returns its state, propagated by the IMU alone.
  FrameState AddFrame(const FrameMeasurement& measurement);
  // Returns the time of the image at which standstill began; nullopt in motion, even if slow.
  std::optional<int64_t> StillSince(
      const std::optional<StandstillDetector::Standstill>& standstill) const;
  // Places the newest frame and, if that is not sufficient, optimizes the window.
  Step Solve(bool keep_second_newest);
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
  std::vector<std::vector<PixelResidual>> MiddleResiduals() const;
  PointMap::Fit FitOfNewest(int64_t keyframe_ns) const;
  DepartedLandmarks SlideWindow(bool keep_second_newest);
  DepartedLandmarks SlideOldest();
  // Returns the output without the estimate.
  EstimatorOutput Report(const Step& step) const;
  EstimatorOutput Describe(const Step& step) const;

  bool WindowIsFull() const;
  const SolverOptions& CurrentSolution() const;
  // Returns the problem's options with the current Manhattan frame and noise.
  ProblemOptions CurrentProblem(JacobiansAt jacobians_at) const;

  const Config* config_;
  const EstimatorOptions* options_;
  bool started_ = false;
  DepthEvidence depth_evidence_;
  WindowEstimate estimate_;
  LineStructure structure_;
  ViewNoise noise_;
  RigMonitor rig_monitor_;
  DepthFaults depth_faults_;
  ImuNoiseLearning imu_noise_;
  ImuAgreement imu_agreement_;
  EstimateMonitor estimate_monitor_;
  Keyframe keyframe_;
};

}  // namespace plm_vins
