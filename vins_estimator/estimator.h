// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/bridging/frame_bridge.h"
#include "vins_estimator/bridging/uncertain_state.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/input/measurement_check.h"
#include "vins_estimator/input/rolling_shutter.h"
#include "vins_estimator/map/view_noise.h"
#include "vins_estimator/marginalization/window_estimate.h"
#include "vins_estimator/monitoring/estimate_monitor.h"
#include "vins_estimator/monitoring/imu_agreement.h"
#include "vins_estimator/problem/imu_noise_learning.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/structure/line_structure.h"

namespace plm_vins {

// Visual-inertial odometry in a sliding window: one call per image, one stage per line of Track().
// Synchronous and deterministic: the same measurements give the same output, bit by bit.
class Estimator {
 public:
  explicit Estimator(const Config& config);

  // Takes the next image's features and IMU samples. Throws std::invalid_argument, and is as
  // before, where CheckMeasurement() refuses them.
  EstimatorOutput Process(const FrameMeasurement& measurement);

  // Forgets everything but the configuration and starts over with initialisation.
  void Reset();

  // Time offset td as estimated so far [s]: what MeasurementSync should cut the IMU with.
  double time_offset() const { return state_.estimate.map.window.td; }

 private:
  // The newest frame that stays.
  struct Keyframe {
    int64_t t_ns = 0;
    std::optional<Matrix15d> covariance = std::nullopt;  // once the window was solved with it
  };

  // All that an image leaves behind for the next.
  struct State {
    State(const Config& config, const EstimatorOptions& options);

    bool initialized = false;
    std::optional<MeasurementEnd> newest;
    Initializer initializer;
    StandstillDetector standstill_detector;
    std::optional<RollingShutter> rolling_shutter;  // where the camera has one
    EstimateMonitor estimate_monitor;
    ImuAgreement imu_agreement;
    LineStructure structure;
    WindowEstimate estimate;
    ViewNoise noise;
    ImuNoiseLearning imu_noise;
    FrameState predicted;  // of the newest image, from the IMU alone
    Keyframe keyframe;
    bool solved = false;          // what was last optimised had a solution
    Matrix15d newest_covariance;  // as optimised; zero where the problem is singular
    FrameBridge bridge;
  };

  // The image as a global shutter would have taken it, in rays of the camera as it is known so far.
  FrameMeasurement Correct(FrameMeasurement measurement);
  // Hands the image on to Initialize() or Track().
  void Use(const FrameMeasurement& measurement, EstimatorOutput* output);
  void Initialize(const FrameMeasurement& measurement, EstimatorOutput* output);
  void Track(const FrameMeasurement& measurement,
             const std::optional<StandstillDetector::Standstill>& standstill,
             EstimatorOutput* output);

  // Puts a new window into the frame of the world before the loss, where there was one and the
  // bridge leads from there to here. False where that world has to be given up.
  bool KeepFrame(InitializationResult* result, InitialUncertainty* uncertainty) const;
  void BeginWorld(EstimatorOutput* output);
  void StartWindow(const InitializationResult& result, const InitialUncertainty& uncertainty);
  void SolveFirstWindow(EstimatorOutput* output);
  void AddFrame(const FrameMeasurement& measurement);
  void PlaceNewest(EstimatorOutput* output);
  bool PlacementSuffices() const;
  void Triangulate(EstimatorOutput* output);
  void FindStructure(bool keep_second_newest, EstimatorOutput* output);
  void LearnFromWindow(EstimatorOutput* output);
  void CountLandmarks(EstimatorOutput* output) const;
  PointMap::Fit FitOfNewest(int64_t keyframe_ns) const;
  std::optional<Failure> CheckEstimate(const EstimatorCounts& counts);
  void GiveUp(const Failure& failure, EstimatorOutput* output);
  // Since which image; nothing where the newest image shows that it is a slow motion.
  std::optional<int64_t> StillSince(
      const std::optional<StandstillDetector::Standstill>& standstill) const;
  void Optimize(const SolverOptions& options, EstimatorOutput* output);
  void SlideWindow(bool keep_second_newest, EstimatorOutput* output);
  void SlideOldest(EstimatorOutput* output);
  void Describe(EstimatorOutput* output) const;

  bool WindowIsFull() const;
  const SolverOptions& CurrentSolution() const;
  // The problem's options with Manhattan frame and noise as they are now.
  ProblemOptions CurrentProblem(JacobiansAt jacobians_at) const;

  const Config config_;
  const EstimatorOptions options_;
  State state_;
};

}  // namespace plm_vins
