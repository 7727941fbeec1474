// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace plm_vins {

// Stages of one frame, in the order of the columns of timing.csv.
enum TimingStage : size_t {
  kPointTracking,
  kLineDetection,
  kLineTracking,  // the whole line front end, including detection
  kInitialization,
  kLineMerging,  // includes the search for the Manhattan frame
  kOptimization,
  kMarginalization,
  kEstimator,  // the whole back end
  kTotal,      // front ends and back end
  kTimingStages
};

constexpr std::array<const char*, kTimingStages> kTimingNames = {
    "point_tracking", "line_detection",  "line_tracking", "initialization", "line_merging",
    "optimization",   "marginalization", "estimator",     "total"};

// Processing times of one frame's stages [ms].
using FrameTimings = std::array<double, kTimingStages>;

}  // namespace plm_vins
