// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace plm_vins {

// Mean, median, 95th and 99th percentile (nearest rank); zeros if there are no values.
struct SeriesSummary {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double p99 = 0;
};

// Summarizes entry `index` of each frame's values.
template <typename T, size_t kSize>
SeriesSummary Summarize(const std::vector<std::array<T, kSize>>& frames, size_t index) {
  if (frames.empty()) return {};
  std::vector<double> values;
  values.reserve(frames.size());
  for (const auto& frame : frames) values.push_back(static_cast<double>(frame[index]));
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto quantile = [&](double share) {
    return values[static_cast<size_t>(std::ceil(share * count)) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / count, quantile(0.5), quantile(0.95),
          quantile(0.99)};
}

}  // namespace plm_vins
