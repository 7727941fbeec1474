// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/config.h"
#include "common/measurements.h"
#include "vins_estimator/estimator_output.h"
#include "vins_estimator/failure_detector.h"
#include "vins_estimator/imu/standstill_detector.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/manhattan/manhattan_frame.h"
#include "vins_estimator/map/keyframe_policy.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/marginalization/window_marginalizer.h"
#include "vins_estimator/merging/line_merging.h"
#include "vins_estimator/optimization/levenberg_marquardt.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/problem_builder.h"
#include "vins_estimator/recall/anchor_policy.h"

namespace plm_vins {

// Visual-inertial odometry in a sliding window: one call per image, one stage per line of Track().
// Synchronous and deterministic: the same measurements give the same output, bit by bit.
class Estimator {
 public:
  explicit Estimator(const Config& config);

  // Takes the next image's features and IMU samples; stamps must increase.
  EstimatorOutput Process(const FrameMeasurement& measurement);

  // Forgets everything but the configuration and starts over with initialisation.
  void Reset();

  // Time offset td as estimated so far [s]: what MeasurementSync should cut the IMU with.
  double time_offset() const { return window_.td; }

 private:
  void Initialize(const FrameMeasurement& measurement, EstimatorOutput* output);
  void Track(const FrameMeasurement& measurement, bool stands_still, EstimatorOutput* output);

  void StartWindow(const InitializationResult& result);
  void AddFrame(const FrameMeasurement& measurement);
  void Triangulate(EstimatorOutput* output);
  void FindStructure(EstimatorOutput* output);
  void RemoveOutliers(EstimatorOutput* output);
  std::optional<std::string> FindFailure(const EstimatorOutput& output);
  bool StandsStill(const FrameMeasurement& measurement);
  void Optimize(int max_iterations, EstimatorOutput* output);
  void SlideWindow(bool keep_second_newest, EstimatorOutput* output);
  void MarginalizeOldestFrame(EstimatorOutput* output);
  void MakeRoomForAnchor();
  std::optional<MapLine> DepartingSegment(const LineLandmark& line) const;
  void DropSecondNewestFrame();
  void Describe(EstimatorOutput* output) const;

  const Config config_;
  const double focal_length_;  // [px]
  const LineTriangulationOptions line_triangulation_options_;
  const LineLimits line_limits_;
  const KeyframePolicyOptions keyframe_options_;
  const AnchorPolicyOptions anchor_options_;

  bool initialized_ = false;
  ProblemOptions problem_options_;  // changes with the Manhattan frame only
  Initializer initializer_;
  StandstillDetector standstill_detector_;
  ContradictionMonitor contradiction_monitor_;
  SlidingWindow window_;
  PointMap points_;
  LineMap lines_;
  ManhattanFrame manhattan_;
  LineMerging line_merging_;
  MarginalizationPrior prior_;
  FrameState predicted_;  // of the newest image, from the IMU alone
};

}  // namespace plm_vins
