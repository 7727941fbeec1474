// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Detects samples that arrive in bursts and are stamped on arrival (by a driver that empties a
// FIFO), or whose timestamps are rounded so that they repeat, and spaces their timestamps evenly.
// Other samples are unchanged, bit by bit. Copies, as by a second publisher, belong to no burst.
//
// The last sample of a burst is the youngest, so its timestamp is taken as correct; the other
// samples precede it in steps of the mean interval. Samples are returned at once, in temporal
// order, except that timestamps step back by one burst when bursts are first detected.
class ImuBursts {
 public:
  // Returns the sample with the timestamp to use.
  ImuSample Spread(ImuSample sample);

  // Approximate number of samples in a burst, and their mean interval [s]; zero without bursts.
  size_t size() const { return size_; }
  double interval() const { return ToSeconds(interval_ns_); }

 private:
  // Sets size_ and interval_ns_ from the newest timestamps.
  void Recognize();
  // `late_ns`: last timestamp of the previous burst minus the one that was assigned to it.
  int64_t SpreadStamp(int64_t t_ns, int64_t late_ns);

  std::optional<ImuSample> newest_;  // as received
  std::deque<int64_t> stamps_;       // newest timestamps, as received
  size_t size_ = 0;
  int64_t interval_ns_ = 0;
  std::optional<int64_t> spread_ns_;  // newest assigned timestamp; nullopt if there is none
};

}  // namespace plm_vins
