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
  kTwins,     // two identical rooms, connected by a corridor
  kIrregular  // room with arbitrary directions of walls and objects
};

// A scene and the box of free space for the flight.
struct World {
  Scene scene;
  Eigen::Vector3d flight_center, flight_extent;  // [m]
};

World MakeWorld(WorldKind kind, TextureStyle style, uint64_t seed);

}  // namespace plm_vins::simulator
