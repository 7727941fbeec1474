// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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

inline SeriesSummary Summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto quantile = [&](double share) {
    return values[static_cast<size_t>(std::ceil(share * count)) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / count, quantile(0.5), quantile(0.95),
          quantile(0.99)};
}

}  // namespace plm_vins
