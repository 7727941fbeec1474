// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulator/rendering/furnisher.h"
#include "simulator/rendering/scene.h"

namespace plm_vins::simulator {

enum class WorldKind {
  kRoom,
  kCorridor,
  kHall,
  kAtlanta,   // a room of two frames: half of its walls and things are turned against the others
  kTwins,     // two equal rooms, joined by a corridor
  kShelves,   // a store room: aisles between rows of equal shelves
  kTiles,     // a room whose walls and floor are of equal tiles with a print
  kIrregular  // a room of walls and things that stand anyhow
};

// A scene and the box within it that is free to fly in.
struct World {
  Scene scene;
  Eigen::Vector3d flight_center, flight_extent;  // [m]
};

World MakeWorld(WorldKind kind, TextureStyle style, uint64_t seed);

}  // namespace plm_vins::simulator
