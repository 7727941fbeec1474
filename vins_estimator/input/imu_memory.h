// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

#include "common/measurements.h"

namespace plm_vins {

// Stores the raw samples of the last second, to detect samples that are sent twice and are no
// evidence of a clock change. The samples in the stream may have been used or modified since.
class ImuMemory {
 public:
  // Adds a sample; samples must be in order of time.
  void Add(const ImuSample& sample);

  // Returns whether a sample with the same timestamp and values is stored.
  bool Contains(const ImuSample& sample) const;

  void Clear() { samples_.clear(); }

 private:
  static constexpr int64_t kSpan_ns = 1'000'000'000;

  std::deque<ImuSample> samples_;
};

}  // namespace plm_vins
