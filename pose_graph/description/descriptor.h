// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plm_vins {

// 256 comparisons of brightness around a corner.
constexpr int kDescriptorBits = 256;
using Descriptor = std::array<uint64_t, kDescriptorBits / 64>;

constexpr int kDescriptorBorder_px = 24;  // how far from the corner they reach, however turned

// Before a function that spends its time on HammingDistance(): processors count bits by an
// instruction that not all of them have, and that compilers therefore do without. It is compiled
// with and without it, and the processor that it runs on decides: four times as fast with it.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__)
#define PLM_COUNTS_BITS [[gnu::target_clones("popcnt", "default")]]
#else
#define PLM_COUNTS_BITS
#endif

// How many bits differ.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (size_t i = 0; i < a.size(); ++i) distance += __builtin_popcountll(a[i] ^ b[i]);
  return distance;
}

}  // namespace plm_vins
