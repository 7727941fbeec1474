// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

#include "common/measurements.h"

namespace plm_vins {

// The samples of the last second as they came, to tell those that are sent twice, which say nothing
// of the clock. They may have been used long since, and not as they came.
class ImuMemory {
 public:
  // In order of time.
  void Add(const ImuSample& sample);

  // One of the same stamp and values.
  bool Contains(const ImuSample& sample) const;

  void Clear() { samples_.clear(); }

 private:
  static constexpr int64_t kSpan_ns = 1'000'000'000;

  std::deque<ImuSample> samples_;
};

}  // namespace plm_vins
