// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>

#include "vins_estimator/output/frame_columns.h"

namespace plm_vins {

// Writes timing.csv: a header, then one row per frame with timestamp [ns], durations [ms, four
// decimals] and counts.
void WriteFrameHeader(const FrameColumns& columns, std::ostream* stream);
void WriteFrameRow(int64_t t_ns, const FrameColumns& columns, std::ostream* stream);

}  // namespace plm_vins
