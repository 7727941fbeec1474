// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Adds to a sum that forgets `share` of itself with each addend.
inline void AddForgetting(double share, double addend, double* sum) {
  *sum += addend - share * *sum;
}

}  // namespace plm_vins
