// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

namespace plm_vins {

// Identifies an image of the map.
struct MapImage {
  int keyframe = -1;  // number
  int camera = 0;

  bool operator==(const MapImage& other) const {
    return keyframe == other.keyframe && camera == other.camera;
  }
  bool operator<(const MapImage& other) const {
    return std::tie(keyframe, camera) < std::tie(other.keyframe, other.camera);
  }
};

}  // namespace plm_vins
