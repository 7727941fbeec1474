// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

#include "common/config/sensor_config.h"
#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// The local map and the marginalization prior, kept in step: whatever leaves the map is
// marginalized into the prior. Two kinds of observation are used twice: the newest observation of a
// landmark that is marginalized but still tracked, since that frame becomes its host; and the line
// observations that anchors keep, which are down-weighted when the line is re-observed
// (docs/merging.md).
struct WindowEstimate {
  explicit WindowEstimate(LocalMap local_map) : map(std::move(local_map)) {}

  // Marginalizes the second newest frame, a non-keyframe, and drops its observations.
  void DropSecondNewest();

  // Marginalizes the oldest frame with the landmarks that it hosts; see LocalMap::SlideOldest().
  DepartedLandmarks SlideOldest(const ProblemOptions& options, bool stays_as_anchor);

  void RemoveAnchor(int64_t t_ns);

  LocalMap map;
  MarginalizationPrior prior;
};

// Returns the calibration of a window.
Calibration CalibrationIn(const SlidingWindow& window, const SensorConfig& sensor);

// Returns a window without frames and with the configured calibration.
WindowEstimate EmptyWindow(const SensorConfig& sensor, const LocalMapOptions& options);

}  // namespace plm_vins
