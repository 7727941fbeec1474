// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/config/sensor_config.h"
#include "common/config/stereo_pairs.h"
#include "common/measurements.h"
#include "vins_estimator/lengths/ratio_curve.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Compares a length that the configuration states, the baseline of two cameras or the unit of
// measured depths, with the IMU, which needs no estimate: stereo odometry over pieces of three
// seconds gives the camera's path in stated lengths, and the IMU tells how long it is. Cameras that
// are turned against each other bias the depths of such a piece, so an error of less than about
// 25 % may not show; the estimator, which knows the cameras' rotations, adds its evidence later.
// The length is wrong if either rules it out by five standard deviations, and by more than 5 %,
// which no calibration is off. Once the ratio is known well, nothing is computed any more.
class LengthCheck {
 public:
  // Without a pair, measured depths are checked. `point_noise_px` is the standard deviation of a
  // corner.
  LengthCheck(const SensorConfig& sensor, double point_noise_px, std::optional<StereoPair> pair);

  // Adds the next image.
  void Add(const FrameMeasurement& measurement);

  // Adds the evidence of the estimator on the logarithm of the ratio. If it disagrees with the
  // odometry, it is no fact about the length: other faults deceive each in another way. Where
  // points are too far away for the odometry, as in a large hall, the estimator decides alone.
  void Add(const LengthEvidence& log_ratio);

  // Drops the images of the current piece, as after a jump of the clock.
  void Interrupt();

  // Ratio of the stated length to the true one.
  const RatioEstimate& ratio() const { return ratio_; }
  // Standard deviations by which the stated length is ruled out. The estimator's evidence counts as
  // just significant: checks that need no estimate, as of turned cameras, explain it as well.
  double contradiction() const;
  // Returns whether the length is wrong. This is final.
  bool is_wrong() const { return is_wrong_; }

  // Both are for a wrong length. The estimator's evidence is linear, so that it tells the direction
  // of a large error, but not the ratio.
  bool IsTooLong() const;
  bool KnowsRatio() const;

  // Returns the relative standard deviation of the length as far as this check or the estimator
  // compared it with the IMU: at most one, and zero once nothing is left to compare, as the length
  // fits or is not used, or while no observation depends on it.
  double Doubt() const;

  // Returns whether the length is neither known well nor wrong.
  bool is_open() const { return !is_known_ && !is_wrong_; }

  const std::optional<StereoPair>& pair() const { return pair_; }

 private:
  FrameMeasurement OfSource(const FrameMeasurement& measurement) const;
  bool DependsOnLength(const PointFrame& frame) const;
  bool ShortenRest();
  std::optional<RatioCurve> CurveOfPiece();
  void Judge(const RatioCurve& curve);

  const SensorConfig sensor_;
  const double noise_;  // of a normalized coordinate
  const std::optional<StereoPair> pair_;
  std::deque<FrameMeasurement> piece_;
  std::optional<int64_t> judged_ns_;  // newest image at the last judgement
  std::optional<int64_t> used_ns_;    // newest image with observations that depend on the length
  RatioCurve earlier_;                // of all pieces before
  RatioEstimate ratio_;
  double scale_information_ = 0;  // of the depths in all pieces before
  double scale_information_of_piece_ = 0;
  std::optional<double> by_estimator_;  // log ratio, if the estimator has ruled the length out
  double doubt_of_estimator_ = 1;
  int contradictions_ = 0;  // consecutive judgements that rule the length out
  bool is_wrong_ = false, is_known_ = false;
};

}  // namespace plm_vins
