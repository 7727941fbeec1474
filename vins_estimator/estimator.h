// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/bridging/frame_bridge.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/input/measurement_check.h"
#include "vins_estimator/input/rolling_shutter.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/window_odometry.h"

namespace plm_vins {

// Visual-inertial odometry: starts, tracks in a sliding window, and starts again after a loss, in
// the same world where the IMU leads back to it. One call per image. Synchronous and deterministic:
// the same measurements give the same output, bit by bit.
class Estimator {
 public:
  explicit Estimator(const Config& config);
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;

  // Takes the next image's features and IMU samples. Throws std::invalid_argument, and is as
  // before, where CheckMeasurement() refuses them.
  EstimatorOutput Process(const FrameMeasurement& measurement);

  // Forgets everything but the configuration and starts over with initialisation.
  void Reset();

  // Time offset td as estimated so far [s]: what MeasurementSync should cut the IMU with.
  double time_offset() const { return state_.odometry.window().td; }

 private:
  // All that an image leaves behind for the next.
  struct State {
    State(const Config& config, const EstimatorOptions& options);

    std::optional<MeasurementEnd> newest;
    Initializer initializer;
    StandstillDetector standstill_detector;
    std::optional<RollingShutter> rolling_shutter;  // where the camera has one
    WindowOdometry odometry;
    FrameBridge bridge;
  };

  // The image as a global shutter would have taken it, in rays of the camera as it is known so far.
  FrameMeasurement Correct(FrameMeasurement measurement);
  // Hands the image on to Initialize() or Track().
  void Use(const FrameMeasurement& measurement, EstimatorOutput* output);
  void Initialize(const FrameMeasurement& measurement, EstimatorOutput* output);
  // Puts a new window into the frame of the world before the loss, where there was one and the
  // bridge leads from there to here. False where that world has to be given up.
  bool KeepFrame(InitializationResult* result, InitialUncertainty* uncertainty) const;
  void BeginWorld(EstimatorOutput* output);
  void Track(const FrameMeasurement& measurement,
             const std::optional<StandstillDetector::Standstill>& standstill,
             EstimatorOutput* output);
  void GiveUp(const Failure& failure, EstimatorOutput* output);

  const Config config_;
  const EstimatorOptions options_;
  State state_;
};

}  // namespace plm_vins
