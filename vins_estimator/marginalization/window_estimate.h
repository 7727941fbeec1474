// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

#include "common/config/sensor_config.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/problem/marginalization_prior.h"
#include "vins_estimator/problem/problem_options.h"

namespace plm_vins {

// The local map, and the prior in which all that left it lives on. Both move in step: what is taken
// out of the map is folded into the prior and never lost. Two things are used twice: the newest
// view of a landmark that goes into the prior and is still seen, which hosts it from then on, and
// the views that anchors keep of lines, which count less when the line comes back
// (docs/merging.md).
struct WindowEstimate {
  explicit WindowEstimate(LocalMap local_map) : map(std::move(local_map)) {}

  // Marginalises the frame before the newest, which is no keyframe: what it has seen is given up.
  void DropSecondNewest();

  // Marginalises the oldest frame with the landmarks that it hosts; see LocalMap::SlideOldest().
  DepartedLandmarks SlideOldest(const ProblemOptions& options, bool stays_as_anchor);

  void RemoveAnchor(int64_t t_ns);

  LocalMap map;
  MarginalizationPrior prior;
};

// Without frames, with the calibration as configured.
WindowEstimate EmptyWindow(const SensorConfig& sensor, const LocalMapOptions& options);

}  // namespace plm_vins
