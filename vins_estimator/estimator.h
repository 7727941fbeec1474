// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/config/config.h"
#include "common/measurements.h"
#include "common/recent_time.h"
#include "vins_estimator/bridging/frame_bridge.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/input/measurement_check.h"
#include "vins_estimator/input/rolling_shutter.h"
#include "vins_estimator/monitoring/lens_monitor.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/window_odometry.h"

namespace plm_vins {

// Visual-inertial odometry: initializes, tracks in a sliding window, and reinitializes after a
// loss, in the same world frame if the IMU bridges the loss. One call per image. Synchronous and
// deterministic: the same measurements give the same output, bit by bit.
class Estimator {
 public:
  explicit Estimator(const Config& config);
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;

  // Processes the next image's features and IMU samples. Throws std::invalid_argument and does not
  // change if CheckMeasurement() rejects them.
  EstimatorOutput Process(const FrameMeasurement& measurement);

  // Drops everything except the configuration and reinitializes.
  void Reset();

  // Fit of the distortion model, over all world frames.
  const std::vector<LensMonitor>& lenses() const { return lenses_; }  // by camera

  // Returns whether the images have shown motion for long that the IMU does not measure.
  bool SeesUnfeltMotion() const { return world_.unfelt_motion.IsLong(); }

  // Returns whether the view has moved along with the body for long, as in a lift.
  bool ViewMovesAlong() const { return world_.unseen_motion.IsLong(); }

  // Current estimate of the time offset td [s], with which MeasurementSync should cut the IMU
  // samples.
  double time_offset() const { return world_.odometry.window().td; }

 private:
  // All state that a restart recreates.
  struct PerWorld {
    PerWorld(const Config& config, const EstimatorOptions& options);

    std::optional<MeasurementEnd> newest;
    RecentTime unfelt_motion, unseen_motion;
    Initializer initializer;
    StandstillDetector standstill_detector;
    std::optional<RollingShutter> rolling_shutter;  // if the camera has one
    WindowOdometry odometry;
    FrameBridge bridge;
  };

  // Returns the image as a global shutter would have taken it, with rays of the current intrinsics.
  FrameMeasurement Correct(FrameMeasurement measurement);
  // Passes the image to Initialize() or Track().
  EstimatorOutput Use(const FrameMeasurement& measurement, int features_observed);
  EstimatorOutput Initialize(const FrameMeasurement& measurement);
  // Transforms a new window to the world frame before the loss, if the bridge reaches it and both
  // agree. Returns false if a new world frame must begin.
  bool KeepFrame(InitializationResult* result, InitialUncertainty* uncertainty) const;
  EstimatorOutput Track(const FrameMeasurement& measurement,
                        const std::optional<StandstillDetector::Standstill>& standstill,
                        int features_observed);
  // Returns whether the next initialization begins a new world frame.
  bool GiveUp(const Failure& failure);

  const Config config_;
  const EstimatorOptions options_;
  PerWorld world_;
  std::vector<LensMonitor> lenses_;
};

}  // namespace plm_vins
