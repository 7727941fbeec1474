// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/failure/estimate_monitor.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/map/pixel_residuals.h"
#include "vins_estimator/problem/initial_prior.h"
#include "vins_estimator/state/estimator_output.h"
#include "vins_estimator/uncertainty/depth_evidence.h"
#include "vins_estimator/window_optimizer.h"

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

  // Fills the window with the initial frames and optimizes it. Returns nullopt if this contradicts
  // the initial states; the object must not be used then.
  std::optional<EstimatorOutput> Start(const InitializationResult& result,
                                       const InitialUncertainty& uncertainty);
  bool started() const { return started_; }

  // Median depth of the known points in the newest image [m]; nullopt if there are few, or if no
  // motion since the start can have told it: noise then places points arbitrarily near.
  std::optional<double> MedianDepth() const {
    if (!started_ || !depth_evidence_.is_known()) return std::nullopt;
    return optimizer_.estimate().map.points.MedianDepthInNewest(window());
  }

  // Processes the next image; requires started(). `features_observed` counts the features of the
  // image, even if they are not in the measurement because they are not to be used.
  Tracked Track(const FrameMeasurement& measurement,
                const std::optional<StandstillDetector::Standstill>& standstill,
                int features_observed);

  // The window with calibration and gravity; as configured before the start.
  const SlidingWindow& window() const { return optimizer_.estimate().map.window; }

 private:
  using Step = WindowOptimizer::Step;

  void Fill(const InitializationResult& result, const InitialUncertainty& uncertainty);
  // Declares the newest frame stationary, or moving, even if slowly.
  void SetStandstill(const std::optional<StandstillDetector::Standstill>& standstill);
  std::vector<std::vector<PixelResidual>> MiddleResiduals() const;
  DepartedLandmarks SlideWindow(bool keep_second_newest);
  DepartedLandmarks SlideOldest();
  // Returns the output without the estimate.
  EstimatorOutput Report(const Step& step) const;
  EstimatorOutput Describe(const Step& step) const;

  const Config* config_;
  const EstimatorOptions* options_;
  bool started_ = false, from_standstill_ = false;
  int64_t start_ns_ = 0;  // time of the first pose
  DepthEvidence depth_evidence_;
  WindowOptimizer optimizer_;
  EstimateMonitor estimate_monitor_;
};

}  // namespace plm_vins
