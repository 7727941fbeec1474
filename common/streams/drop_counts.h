// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plm_vins {

// How often one kind of unusable input occurred.
struct DropCount {
  std::string cause;  // a key for reports, e.g. "imu_not_finite"
  int64_t count = 0;
  std::string detail;  // what the first one was, for the message; may be empty

  void Add(const std::string& what) {
    if (count++ == 0) detail = what;
  }
};

using DropCounts = std::vector<DropCount>;

// "imu_not_finite: 3 (first: ...)".
inline std::string ToString(const DropCount& drop) {
  const std::string text = drop.cause + ": " + std::to_string(drop.count);
  return drop.detail.empty() ? text : text + " (first: " + drop.detail + ")";
}

}  // namespace plm_vins
