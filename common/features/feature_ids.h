// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace plm_vins {

// Feature messages carry ids as float32, which represents whole numbers exactly up to here.
constexpr int64_t kTransportableIds = int64_t{1} << 24;

// The id as transmitted: modulo kTransportableIds.
inline int64_t WrapId(int64_t id) { return id % kTransportableIds; }

// Converts a received id. Throws std::invalid_argument if it is not a transmittable id, since a
// float32 from kTransportableIds on is ambiguous.
inline int64_t ReadId(float value) {
  if (!(value >= 0 && value < static_cast<float>(kTransportableIds)) ||
      value != std::floor(value)) {
    throw std::invalid_argument("feature message with the id " + std::to_string(value) +
                                ": not a whole number from 0 to 2^24 - 1");
  }
  return static_cast<int64_t>(value);
}

// Restores the full ids of a tracker from transmitted ones, and distinguishes them from those of a
// restarted tracker, which counts from zero again.
class IdRestorer {
 public:
  // Declares that the ids restored from now on belong to another tracker.
  void BeginTracker() {
    begin_ = highest_ + 1;
    wrap_ = 0;
  }

  // Returns the id nearest to the highest one of this tracker, since new ids increase.
  int64_t Restore(int64_t wrapped) {
    int64_t id = begin_ + wrap_ + wrapped;
    if (id + kTransportableIds / 2 < highest_) id += kTransportableIds;
    if (id - kTransportableIds / 2 > highest_ && wrap_ > 0) id -= kTransportableIds;
    wrap_ = std::max(wrap_, id - begin_ - wrapped);
    highest_ = std::max(highest_, id);
    return id;
  }

 private:
  int64_t begin_ = 0;     // first id of this tracker
  int64_t wrap_ = 0;      // largest multiple of kTransportableIds reached by this tracker
  int64_t highest_ = -1;  // highest restored id
};

}  // namespace plm_vins
