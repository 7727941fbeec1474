// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

namespace plm_vins {

// The stages of one frame in the order of the columns of timing.csv.
enum TimingStage : size_t {
  kPointTracking,
  kLineDetection,
  kLineTracking,  // all of the line front end, detection included
  kInitialization,
  kOptimization,
  kMarginalization,
  kEstimator,  // all of the back end
  kTotal,      // front ends and back end
  kTimingStages
};

constexpr std::array<const char*, kTimingStages> kTimingNames = {
    "point_tracking", "line_detection",  "line_tracking", "initialization",
    "optimization",   "marginalization", "estimator",     "total"};

// What the stages of one frame took [ms].
using FrameTimings = std::array<double, kTimingStages>;

// timing.csv: a line of names, then one row per frame, milliseconds with four decimals.
void WriteTimingHeader(std::ostream* stream);
void WriteTimingRow(int64_t t_ns, const FrameTimings& timings, std::ostream* stream);

// Mean and 95th percentile (nearest rank) of a stage [ms]; zeros for no frames.
struct TimingSummary {
  double mean = 0;
  double p95 = 0;
};
TimingSummary Summarize(const std::vector<FrameTimings>& frames, TimingStage stage);

}  // namespace plm_vins
