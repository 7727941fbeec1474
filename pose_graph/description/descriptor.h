// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plm_vins {

// A binary descriptor: 256 intensity comparisons around a corner.
constexpr int kDescriptorBits = 256;
using Descriptor = std::array<uint64_t, kDescriptorBits / 64>;

constexpr int kDescriptorBorder_px = 24;  // reach of the comparisons at any rotation

// Attribute for functions dominated by HammingDistance(). It compiles them with and without the
// POPCNT instruction, which not all x86-64 processors have, and selects at load time; POPCNT makes
// them four times as fast.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__)
#define PLM_COUNTS_BITS [[gnu::target_clones("popcnt", "default")]]
#else
#define PLM_COUNTS_BITS
#endif

// Number of differing bits.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (size_t i = 0; i < a.size(); ++i) distance += __builtin_popcountll(a[i] ^ b[i]);
  return distance;
}

}  // namespace plm_vins
