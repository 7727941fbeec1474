// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Recognizes samples that come in bursts and are stamped on arrival (a driver that empties a FIFO),
// and spreads their stamps evenly. Other samples stay as they are, bit by bit.
//
// Of a burst, the last sample is the youngest, so that its stamp is taken for right; the stamps of
// the others lie before it in steps of the mean interval. Samples come out at once, in order of
// time, except that stamps step back by a burst where bursts are recognized.
class ImuBursts {
 public:
  // Returns the sample with the stamp to use.
  ImuSample Spread(ImuSample sample);

  // Samples in a burst, about, and their mean interval [s]; zero while there are no bursts.
  size_t size() const { return size_; }
  double interval() const { return ToSeconds(interval_ns_); }

 private:
  // Sets size_ and interval_ns_ by the newest stamps.
  void Recognize();
  // `late_ns`: by how much the last stamp of the burst before was later than what it was spread to.
  int64_t SpreadStamp(int64_t t_ns, int64_t late_ns);

  std::deque<int64_t> stamps_;  // the newest, as they came
  size_t size_ = 0;
  int64_t interval_ns_ = 0;
  std::optional<int64_t> spread_ns_;  // the newest stamp that was spread; nullopt where it begins
};

}  // namespace plm_vins
