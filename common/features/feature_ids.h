// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace plm_vins {

// Feature messages carry ids as float32, which is exact for whole numbers up to here.
constexpr int64_t kTransportableIds = int64_t{1} << 24;

// An id as it travels: modulo kTransportableIds.
inline int64_t WrapId(int64_t id) { return id % kTransportableIds; }

// An id that has travelled. From kTransportableIds on, a float32 is taken for its neighbours; so
// what is no such id throws std::invalid_argument.
inline int64_t ReadId(float value) {
  if (!(value >= 0 && value < static_cast<float>(kTransportableIds)) ||
      value != std::floor(value)) {
    throw std::invalid_argument("feature message with the id " + std::to_string(value) +
                                ": not a whole number from 0 to 2^24 - 1");
  }
  return static_cast<int64_t>(value);
}

// Restores the ids of a tracker from wrapped ones, and keeps apart those of a tracker that was
// started again and counts from zero once more.
class IdRestorer {
 public:
  // What comes from here on is of another tracker.
  void BeginTracker() {
    begin_ = highest_ + 1;
    wrap_ = 0;
  }

  // The id that is nearest to the highest one of this tracker; new ids come in order.
  int64_t Restore(int64_t wrapped) {
    int64_t id = begin_ + wrap_ + wrapped;
    if (id + kTransportableIds / 2 < highest_) id += kTransportableIds;
    if (id - kTransportableIds / 2 > highest_ && wrap_ > 0) id -= kTransportableIds;
    wrap_ = std::max(wrap_, id - begin_ - wrapped);
    highest_ = std::max(highest_, id);
    return id;
  }

 private:
  int64_t begin_ = 0;     // of the ids of this tracker
  int64_t wrap_ = 0;      // multiple of kTransportableIds that this tracker has reached
  int64_t highest_ = -1;  // id given out so far
};

}  // namespace plm_vins
