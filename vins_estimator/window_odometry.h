// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/bridging/uncertain_state.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/map/view_noise.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/monitoring/estimate_monitor.h"
#include "vins_estimator/monitoring/imu_agreement.h"
#include "vins_estimator/problem/imu_noise_learning.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/structure/line_structure.h"

namespace plm_vins {

// Odometry in a sliding window, from a start to a loss: one call per image, one stage per line of
// Track().
class WindowOdometry {
 public:
  // Both must outlive it.
  WindowOdometry(const Config& config, const EstimatorOptions& options);

  // What came of an image.
  struct Tracked {
    UncertainState newest;           // covariance of zero: not known
    std::optional<Failure> failure;  // the estimate cannot be kept: begin with another one
  };

  // Fills the window and solves it.
  void Start(const InitializationResult& result, const InitialUncertainty& uncertainty,
             EstimatorOutput* output);
  bool started() const { return started_; }

  // Takes the next image, once started.
  Tracked Track(const FrameMeasurement& measurement,
                const std::optional<StandstillDetector::Standstill>& standstill,
                EstimatorOutput* output);

  // With calibration and gravity; before the start as configured.
  const SlidingWindow& window() const { return estimate_.map.window; }

 private:
  // The newest frame that stays.
  struct Keyframe {
    int64_t t_ns = 0;
    std::optional<Matrix15d> covariance = std::nullopt;  // once the window was solved with it
  };

  // What came of solving for the newest frame.
  struct Solution {
    bool exists = false;  // the equations had one
    // Of the newest state; zero where that is not known.
    Matrix15d covariance = Matrix15d::Zero();

    Matrix6d PoseCovariance() const { return covariance.topLeftCorner<6, 6>(); }
  };

  void Fill(const InitializationResult& result, const InitialUncertainty& uncertainty);
  Solution SolveFirstWindow(EstimatorOutput* output);
  // Returns its state by the IMU alone.
  FrameState AddFrame(const FrameMeasurement& measurement);
  // Since which image; nothing where the newest image shows that it is a slow motion.
  std::optional<int64_t> StillSince(
      const std::optional<StandstillDetector::Standstill>& standstill) const;
  // Places the newest frame, and solves the window where that does not suffice.
  Solution Solve(bool keep_second_newest, EstimatorOutput* output);
  Solution PlaceNewest(EstimatorOutput* output);
  bool Suffices(const Solution& placement) const;
  void FindBack(EstimatorOutput* output);
  Solution SolveWindow(const SolverOptions& options, EstimatorOutput* output);
  void Triangulate(EstimatorOutput* output);
  void FindStructure(bool keep_second_newest, EstimatorOutput* output);
  void LearnFromWindow(EstimatorOutput* output);
  void CountLandmarks(EstimatorOutput* output) const;
  PointMap::Fit FitOfNewest(int64_t keyframe_ns) const;
  // Why the estimate cannot be kept; nothing where it can.
  std::optional<Failure> Check(const Solution& solution, const FrameState& predicted,
                               const EstimatorCounts& counts);
  void SlideWindow(bool keep_second_newest, EstimatorOutput* output);
  void SlideOldest(EstimatorOutput* output);
  void Describe(const Solution& solution, EstimatorOutput* output) const;

  bool WindowIsFull() const;
  const SolverOptions& CurrentSolution() const;
  // The problem's options with Manhattan frame and noise as they are now.
  ProblemOptions CurrentProblem(JacobiansAt jacobians_at) const;

  const Config* config_;
  const EstimatorOptions* options_;
  bool started_ = false;
  WindowEstimate estimate_;
  LineStructure structure_;
  ViewNoise noise_;
  ImuNoiseLearning imu_noise_;
  ImuAgreement imu_agreement_;
  EstimateMonitor estimate_monitor_;
  Keyframe keyframe_;
};

}  // namespace plm_vins
