// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace plm_vins {

// Distinguishes a stream of stamps that begins anew (a bag played again, a clock set back) from
// single stamps out of order: more than `patience` in a row are refused, each after the one before.
class BackwardJumpDetector {
 public:
  explicit BackwardJumpDetector(int patience) : patience_(patience) {}

  // A stamp that follows the last accepted one.
  void Accept() { refused_in_a_row_ = 0; }

  // A stamp that does not. True: with it the stream begins anew.
  bool Refuse(int64_t t_ns) {
    refused_in_a_row_ = t_ns > refused_ns_ ? refused_in_a_row_ + 1 : 1;
    refused_ns_ = t_ns;
    return refused_in_a_row_ > patience_;
  }

 private:
  int patience_;
  int refused_in_a_row_ = 0;
  int64_t refused_ns_ = 0;
};

}  // namespace plm_vins
