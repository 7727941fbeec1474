// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plm_vins {

// 256 comparisons of brightness around a corner.
constexpr int kDescriptorBits = 256;
using Descriptor = std::array<uint64_t, kDescriptorBits / 64>;

// How many bits differ. Half of the time of loop closure would be spent here: processors count bits
// by an instruction that not all of them have, and that compilers therefore do without. So they are
// added in place, in fields of 2, 4, 8 and 16 bits, all words in common as soon as that fits.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  uint64_t bytes = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    uint64_t word = a[i] ^ b[i];
    word -= word >> 1 & 0x5555555555555555;
    word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
    bytes += (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
  }
  const uint64_t pairs = (bytes & 0x00ff00ff00ff00ff) + (bytes >> 8 & 0x00ff00ff00ff00ff);
  return static_cast<int>(pairs * 0x0001000100010001 >> 48);
}

}  // namespace plm_vins
