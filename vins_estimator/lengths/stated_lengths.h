// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "vins_estimator/lengths/length_check.h"

namespace plm_vins {

// The lengths that a configuration states, baselines and the unit of depths, each with its check,
// and what of the input and of the configuration may be used. Depths that are not aligned to the
// camera are not used either. Keeps the last images as long as a length is in question, so that the
// estimate can be repeated without it.
class StatedLengths {
 public:
  explicit StatedLengths(const Config& config);

  // Adds the next image, and what the estimator reported with the one before. Returns whether a
  // length has just been found wrong.
  bool Add(const FrameMeasurement& measurement, const EstimatorReport& previous = {});

  // Drops the stored images, as when the clock jumps. What was found stays.
  void StartOver();

  // Returns the input without wrong lengths: depths, or features of the second camera of a pair.
  // Depths beyond depth_max are dropped as well.
  FrameMeasurement Usable(FrameMeasurement measurement) const;
  Config Usable(Config config) const;

  // The images before the newest one, oldest first.
  const std::deque<FrameMeasurement>& images() const { return images_; }

  // Describes the wrong lengths, with the keys and what to do; empty if there are none.
  std::string Finding() const;

  // Returns the relative standard deviation of the least known of the lengths that are used. It is
  // that of the scale of the estimate.
  double Doubt() const;

  // Returns by how many standard deviations the worst of the wrong lengths is ruled out.
  double Contradiction() const;

 private:
  bool IsDropped(int camera) const;
  bool DropsDepth() const;
  std::string Describe(const LengthCheck& check) const;

  // Returns the misalignment of depths that was found once their unit is known, or has stayed
  // unknown for long: depths of another unit seem unaligned as well.
  std::optional<Misalignment> Confirmed(const std::optional<Misalignment>& found, int64_t t_ns);

  const SensorConfig sensor_;
  std::vector<LengthCheck> checks_;        // of pairs, then of depths, unless these are unaligned
  std::optional<int64_t> misaligned_ns_;   // when depths first seemed unaligned
  std::optional<Misalignment> unaligned_;  // of depths; final
  std::deque<FrameMeasurement> images_;
};

// Returns what the values of depth images probably are if they are `ratio` times too long: a unit,
// with what to set, or disparity if no common unit fits within `deviation` of the logarithm; empty
// if a wrong calibration may be the cause.
std::string ProbableDepthUnit(double ratio, double deviation, double depth_unit);

}  // namespace plm_vins
