// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_table.h"

#include "common/format.h"

namespace plm_vins {

void WriteFrameHeader(std::ostream* stream) {
  *stream << "stamp_ns";
  for (const char* name : kTimingNames) *stream << "," << name;
  for (const char* name : kCountNames) *stream << "," << name;
  *stream << "\n";
}

void WriteFrameRow(int64_t t_ns, const FrameTimings& timings, const FrameCounts& counts,
                   std::ostream* stream) {
  *stream << t_ns;
  for (const double milliseconds : timings) *stream << Format(",%.4f", milliseconds);
  for (const int count : counts) *stream << "," << count;
  *stream << "\n";
}

}  // namespace plm_vins
