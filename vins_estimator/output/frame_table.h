// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>

#include "vins_estimator/output/frame_counts.h"
#include "vins_estimator/output/frame_timings.h"

namespace plm_vins {

// Writes timing.csv: a header, then one row per frame with timestamp [ns], durations [ms, four
// decimals] and counts.
void WriteFrameHeader(std::ostream* stream);
void WriteFrameRow(int64_t t_ns, const FrameTimings& timings, const FrameCounts& counts,
                   std::ostream* stream);

}  // namespace plm_vins
