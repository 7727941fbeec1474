// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

class EachWorld : public testing::TestWithParam<WorldKind> {};

// Least distance of the rectangle's points, sampled every 5 cm, from the box; 1 where it is more.
double DistanceFromBox(const Rectangle& r, const Vector3d& center, const Vector3d& extent) {
  double least = 1;
  const double radius = 0.5 * std::hypot(r.width, r.height);
  if ((r.At(0.5 * r.width, 0.5 * r.height) - center).norm() > extent.norm() + radius + 1)
    return least;
  for (double a = 0; a <= r.width; a += 0.05) {
    for (double b = 0; b <= r.height; b += 0.05) {
      const Vector3d outside = ((r.At(a, b) - center).cwiseAbs() - extent).cwiseMax(0.0);
      least = std::min(least, outside.norm());
    }
  }
  return least;
}

TEST_P(EachWorld, LeavesTheFlightBoxFreeAndSurroundsIt) {
  const World world = MakeWorld(GetParam(), TextureStyle::kWeak, 3);
  for (const Rectangle& rectangle : world.scene.rectangles()) {
    const double distance = DistanceFromBox(rectangle, world.flight_center, world.flight_extent);
    EXPECT_GT(distance, 0.1) << "at " << rectangle.corner.transpose();
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {-1.0, 1.0}) {
      double farthest = 0;
      for (const Rectangle& r : world.scene.rectangles()) {
        const bool faces_box = r.Normal()[axis] * side < -0.99;
        if (faces_box) farthest = std::max(farthest, side * (r.corner - world.flight_center)[axis]);
      }
      EXPECT_GT(farthest, world.flight_extent[axis]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, EachWorld,
                         testing::Values(WorldKind::kRoom, WorldKind::kCorridor, WorldKind::kHall));

TEST(World, SeedDecidesWhatItLooksLike) {
  const auto look = [](uint64_t seed) {
    const World world = MakeWorld(WorldKind::kRoom, TextureStyle::kRich, seed);
    double sum = 0;
    for (const MipTexture& texture : world.scene.textures())
      sum += texture.Sample(0.3f, 0.2f, 0.01f);
    return sum;
  };
  EXPECT_EQ(look(1), look(1));
  EXPECT_NE(look(1), look(2));
}

}  // namespace
}  // namespace plm_vins::simulator
