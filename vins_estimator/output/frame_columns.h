// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>
#include <vector>

namespace plm_vins {

// A value of one frame and the name of its column in timing.csv.
template <typename T>
struct Column {
  const char* name;
  T value;
};

// The row of timing.csv of one frame; all frames have the same columns.
struct FrameColumns {
  std::vector<Column<double>> timings;  // of the stages [ms]
  std::vector<Column<int>> counts;      // of features
};

// Writes timing.csv: a header, then one row per frame with timestamp [ns], durations [ms, four
// decimals] and counts.
void WriteFrameHeader(const FrameColumns& columns, std::ostream* stream);
void WriteFrameRow(int64_t t_ns, const FrameColumns& columns, std::ostream* stream);

}  // namespace plm_vins
