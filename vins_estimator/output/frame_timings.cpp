// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_timings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace plm_vins {

void WriteTimingHeader(std::ostream* stream) {
  *stream << "stamp_ns";
  for (const char* name : kTimingNames) *stream << "," << name;
  *stream << "\n";
}

void WriteTimingRow(int64_t t_ns, const FrameTimings& timings, std::ostream* stream) {
  *stream << t_ns;
  for (const double milliseconds : timings) {
    char text[32];
    std::snprintf(text, sizeof(text), ",%.4f", milliseconds);
    *stream << text;
  }
  *stream << "\n";
}

TimingSummary Summarize(const std::vector<FrameTimings>& frames, TimingStage stage) {
  if (frames.empty()) return {};
  std::vector<double> values;
  for (const FrameTimings& frame : frames) values.push_back(frame[stage]);
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {sum / static_cast<double>(values.size()), values[rank - 1]};
}

}  // namespace plm_vins
