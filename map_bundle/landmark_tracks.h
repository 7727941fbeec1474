// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

namespace plm_vins {

// Identifies a landmark in the whole map; track numbers are unique within a world only.
struct LandmarkKey {
  int world = 0;
  int64_t track = -1;

  bool operator<(const LandmarkKey& other) const {
    return std::tie(world, track) < std::tie(other.world, other.track);
  }
};

// A landmark with its observations, at most one for each image: first those of the track in order
// of keyframes and cameras, then those of other visits. The first one is the host.
struct LandmarkTrack {
  struct Observation {
    int keyframe = -1;  // number in the map
    int camera = 0;
    Eigen::Vector2d xy = Eigen::Vector2d::Zero();  // normalized
    std::optional<double> depth = {};              // measured [m]
    bool again = false;                            // matched by a loop closure in another visit
  };

  LandmarkKey key;
  Eigen::Vector3d p_M = Eigen::Vector3d::Zero();  // [m]
  std::vector<Observation> observations;
};

// Observation of a landmark, matched by a loop, in a keyframe of another visit.
struct Reobservation {
  LandmarkKey landmark;
  LandmarkTrack::Observation observation;
};

}  // namespace plm_vins
