// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plm_vins {

// Number of occurrences of one kind of unusable input.
struct DropCount {
  std::string cause;  // key for reports, e.g. "imu_not_finite"
  int64_t count = 0;
  std::string detail;  // description of the first occurrence; may be empty

  void Add(const std::string& what) {
    if (count++ == 0) detail = what;
  }
};

using DropCounts = std::vector<DropCount>;

// Formats "imu_not_finite: 3 (first: ...)".
inline std::string ToString(const DropCount& drop) {
  const std::string text = drop.cause + ": " + std::to_string(drop.count);
  return drop.detail.empty() ? text : text + " (first: " + drop.detail + ")";
}

}  // namespace plm_vins
