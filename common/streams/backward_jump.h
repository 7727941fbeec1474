// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace plm_vins {

// Distinguishes a stream of stamps that begins anew (a bag played again, a clock set back) from
// single stamps out of order: more than `patience` in a row are refused, each after the one before.
// Where it was set back by less, the refused ones lead up to the stamp at which it had been, and
// are followed in their own rhythm by one that is accepted; stragglers are not.
class BackwardJumpDetector {
 public:
  explicit BackwardJumpDetector(int patience) : patience_(patience) {}

  // A stamp that follows the last accepted one.
  void Accept() { refused_in_a_row_ = 0; }

  // A stamp that does not. True: with it the stream begins anew.
  bool Refuse(int64_t t_ns) {
    const bool in_a_row = refused_in_a_row_ > 0 && t_ns > refused_ns_;
    refused_in_a_row_ = in_a_row ? refused_in_a_row_ + 1 : 1;
    if (!in_a_row) first_refused_ns_ = t_ns;
    refused_ns_ = t_ns;
    return refused_in_a_row_ > patience_;
  }

  // The last stamp did not follow.
  bool Refuses() const { return refused_in_a_row_ > 0; }

  // To be asked of a stamp that follows the last accepted one, before Accept(). True: the stream
  // began anew with those that were refused.
  bool EndsStepBack(int64_t t_ns) const {
    return refused_in_a_row_ >= kShortestStep &&
           t_ns - refused_ns_ <= (refused_ns_ - first_refused_ns_) / 2;
  }

 private:
  static constexpr int kShortestStep = 10;  // stamps: fewer may be stragglers

  int patience_;
  int refused_in_a_row_ = 0;
  int64_t first_refused_ns_ = 0;  // of those in a row
  int64_t refused_ns_ = 0;        // the last one
};

}  // namespace plm_vins
