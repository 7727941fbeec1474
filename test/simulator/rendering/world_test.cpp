// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

class EachWorld : public testing::TestWithParam<WorldKind> {};

// Smallest distance of the rectangle's points, sampled every 5 cm, from the box; at most 1.
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

// Returns whether a ray hits the front of the rectangle.
bool Meets(const Vector3d& origin, const Vector3d& direction, const Rectangle& r) {
  const double approach = -direction.dot(r.Normal());
  if (approach <= 0) return false;
  const double distance = (origin - r.corner).dot(r.Normal()) / approach;
  const Vector3d hit = origin + distance * direction - r.corner;
  const double a = hit.dot(r.u), b = hit.dot(r.v);
  return distance > 0 && a >= 0 && a <= r.width && b >= 0 && b <= r.height;
}

// Directions over the whole sphere, at most 5 degrees apart.
std::vector<Vector3d> AllDirections() {
  std::vector<Vector3d> directions;
  for (double elevation = -90; elevation <= 90; elevation += 5) {
    for (double azimuth = 1; azimuth < 360; azimuth += 5) {
      const double e = elevation * M_PI / 180, a = azimuth * M_PI / 180;
      directions.emplace_back(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    }
  }
  return directions;
}

TEST_P(EachWorld, LeavesTheFlightBoxFreeAndSurroundsItWithoutAHole) {
  const World world = MakeWorld(GetParam(), TextureStyle::kWeak, 3);
  const auto& rectangles = world.scene.rectangles();
  for (const Rectangle& rectangle : rectangles) {
    const double distance = DistanceFromBox(rectangle, world.flight_center, world.flight_extent);
    EXPECT_GT(distance, 0.1) << "at " << rectangle.corner.transpose();
  }
  for (const Vector3d& direction : AllDirections()) {
    EXPECT_TRUE(
        std::any_of(rectangles.begin(), rectangles.end(),
                    [&](const Rectangle& r) { return Meets(world.flight_center, direction, r); }))
        << "towards " << direction.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, EachWorld,
                         testing::Values(WorldKind::kRoom, WorldKind::kCorridor, WorldKind::kTwins,
                                         WorldKind::kIrregular));

// Total length of all horizontal edges of vertical rectangles by heading modulo 90 deg, in bins of
// 1 deg, as shares of their sum.
std::vector<double> LevelEdges(WorldKind kind, uint64_t seed) {
  std::vector<double> shares(90, 0.0);
  double sum = 0;
  const World world = MakeWorld(kind, TextureStyle::kWeak, seed);
  for (const Rectangle& r : world.scene.rectangles()) {
    if (std::abs(r.Normal().z()) > 0.01 || std::abs(r.u.z()) > 0.01) continue;
    const double heading = std::atan2(r.u.y(), r.u.x()) * 180 / M_PI;
    shares[static_cast<int>(std::lround(heading) + 360) % 90] += r.width;
    sum += r.width;
  }
  for (double& share : shares) share /= sum;
  std::sort(shares.rbegin(), shares.rend());
  return shares;
}

TEST(World, HasAHorizontalFrameIfItsKindSaysSo) {
  for (uint64_t seed : {1, 2}) {
    EXPECT_GT(LevelEdges(WorldKind::kRoom, seed)[0], 0.8);
    EXPECT_LT(LevelEdges(WorldKind::kIrregular, seed)[0], 0.3);
  }
}

TEST(World, TwinsHaveTwoIdenticalRooms) {
  const World world = MakeWorld(WorldKind::kTwins, TextureStyle::kWeak, 1);
  const auto& rectangles = world.scene.rectangles();
  size_t repeated = 0;
  for (const Rectangle& r : rectangles) {
    repeated += std::any_of(rectangles.begin(), rectangles.end(), [&](const Rectangle& other) {
      return other.corner == r.corner + Vector3d(10, 0, 0) && other.u == r.u && other.v == r.v &&
             other.texture == r.texture && other.texture_u == r.texture_u;
    });
  }
  EXPECT_GT(repeated, 100u);
  constexpr size_t kEnds = 2 * 7;  // a wall with its skirting board, and a box
  EXPECT_EQ(rectangles.size(), 2 * repeated + kEnds);
}

TEST(World, SeedDeterminesTextures) {
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

TEST(World, DoesNotDependOnTheCompiler) {
  const World world = MakeWorld(WorldKind::kIrregular, TextureStyle::kRich, 1);
  double brightness = 0;
  for (const MipTexture& texture : world.scene.textures()) {
    brightness += texture.Sample(0.3f, 0.2f, 0.01f);
  }
  Vector3d corners = Vector3d::Zero();
  for (const Rectangle& r : world.scene.rectangles()) corners += r.corner;
  EXPECT_NEAR(brightness, 17.90, 0.02);
  EXPECT_NEAR(corners.x(), -89.149182, 1e-5);
  EXPECT_NEAR(corners.y(), 19.373854, 1e-5);
}

}  // namespace
}  // namespace plm_vins::simulator
