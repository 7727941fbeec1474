// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace plm_vins::testing {

// Checksum of a map file's content (FNV-1a), for damaged files that pass the checksum test.
inline uint64_t MapChecksum(const std::string& bytes) {
  uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<uint8_t>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace plm_vins::testing
