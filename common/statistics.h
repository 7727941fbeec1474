// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plm_vins {

// Median; for an even number of values the greater of the middle two, and zero without values.
inline double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Adds to an exponentially forgetting sum, which loses `share` of itself with each addend.
template <typename Value>
void AddForgetting(double share, const Value& addend, Value* sum) {
  *sum += addend - share * *sum;
}

}  // namespace plm_vins
