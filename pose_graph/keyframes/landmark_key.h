// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <tuple>

namespace plm_vins {

// Identifies a landmark in the whole map; track numbers are unique within a world only.
struct LandmarkKey {
  int world = 0;
  int64_t track = -1;

  bool operator<(const LandmarkKey& other) const {
    return std::tie(world, track) < std::tie(other.world, other.track);
  }
};

}  // namespace plm_vins
