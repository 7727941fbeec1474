// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstdint>

namespace plm_vins {

// 256 comparisons of brightness around a corner.
constexpr int kDescriptorBits = 256;
using Descriptor = std::array<uint64_t, kDescriptorBits / 64>;

// How many bits differ.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    distance += static_cast<int>(std::bitset<64>(a[i] ^ b[i]).count());
  }
  return distance;
}

}  // namespace plm_vins
