// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

// A series of any length in bounded memory. The mean is exact; percentiles are those of at least
// `kMost` / 2 values that are evenly spaced in the series.
class Series {
 public:
  static constexpr size_t kMost = 1 << 14;

  void Add(double value) {
    sum_ += value;
    if (count_++ % stride_ == 0) values_.push_back(value);
    if (values_.size() == kMost) Halve();
  }

  SeriesSummary Summary() const {
    SeriesSummary summary = Summarize(values_);
    if (count_ > 0) summary.mean = sum_ / static_cast<double>(count_);
    return summary;
  }

 private:
  void Halve() {
    for (size_t i = 0; 2 * i < values_.size(); ++i) values_[i] = values_[2 * i];
    values_.resize(values_.size() / 2);
    stride_ *= 2;
  }

  double sum_ = 0;
  size_t count_ = 0;
  size_t stride_ = 1;  // of the values in the series
  std::vector<double> values_;
};

}  // namespace plm_vins
