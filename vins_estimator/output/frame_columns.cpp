// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_columns.h"

#include "common/format.h"

namespace plm_vins {

void WriteFrameHeader(const FrameColumns& columns, std::ostream* stream) {
  *stream << "stamp_ns";
  for (const auto& timing : columns.timings) *stream << "," << timing.name;
  for (const auto& count : columns.counts) *stream << "," << count.name;
  *stream << "\n";
}

void WriteFrameRow(int64_t t_ns, const FrameColumns& columns, std::ostream* stream) {
  *stream << t_ns;
  for (const auto& timing : columns.timings) *stream << Format(",%.4f", timing.value);
  for (const auto& count : columns.counts) *stream << "," << count.value;
  *stream << "\n";
}

}  // namespace plm_vins
