// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Adds to an exponentially forgetting sum, which loses `share` of itself with each addend.
template <typename Value>
void AddForgetting(double share, const Value& addend, Value* sum) {
  *sum += addend - share * *sum;
}

}  // namespace plm_vins
