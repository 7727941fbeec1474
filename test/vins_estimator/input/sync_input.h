// SPDX-License-Identifier: BSD-3-Clause
// Input for the tests of MeasurementSync.
#pragma once

#include <utility>
#include <vector>

#include "vins_estimator/input/measurement_sync.h"

namespace plm_vins::testing {

constexpr int64_t kMs = 1'000'000;

// A sample whose values are linear in time, so that interpolated values are known.
inline ImuSample Sample(int64_t t_ns) {
  const double t = ToSeconds(t_ns);
  return {t_ns, {t, 2 * t, 3 * t}, {-t, 9.81, 5 * t}};
}

inline PointFrame Points(int64_t t_ns) {
  PointFrame frame;
  frame.t_ns = t_ns;
  frame.points.resize(3);
  return frame;
}

inline LineFrame Lines(int64_t t_ns) {
  LineFrame frame;
  frame.t_ns = t_ns;
  frame.lines.resize(2);
  return frame;
}

// Adds samples at intervals of 5 ms in [begin, end] (ms).
inline void AddImu(MeasurementSync* sync, int64_t begin_ms, int64_t end_ms) {
  for (int64_t t = begin_ms; t <= end_ms; t += 5) sync->AddImu(Sample(t * kMs));
}

inline std::vector<FrameMeasurement> PopAll(MeasurementSync* sync) {
  std::vector<FrameMeasurement> frames;
  while (auto frame = sync->Pop()) frames.push_back(std::move(*frame));
  return frames;
}

inline MeasurementSync::Options WithLines() {
  MeasurementSync::Options options;
  options.expect_lines = true;
  return options;
}

}  // namespace plm_vins::testing
