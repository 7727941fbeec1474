// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace plm_vins {

// The stages of one frame in the order of the columns of timing.csv.
enum TimingStage : size_t {
  kPointTracking,
  kLineDetection,
  kLineTracking,  // all of the line front end, detection included
  kInitialization,
  kLineMerging,  // with the search for the Manhattan frame
  kOptimization,
  kMarginalization,
  kEstimator,  // all of the back end
  kTotal,      // front ends and back end
  kTimingStages
};

constexpr std::array<const char*, kTimingStages> kTimingNames = {
    "point_tracking", "line_detection",  "line_tracking", "initialization", "line_merging",
    "optimization",   "marginalization", "estimator",     "total"};

// What the stages of one frame took [ms].
using FrameTimings = std::array<double, kTimingStages>;

}  // namespace plm_vins
