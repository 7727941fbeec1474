// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/wandering_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNoise = 0.5 / 460;  // normalized
constexpr int kFrames = 12;
constexpr double kDistance = 3;  // of the camera from the z axis [m]
constexpr double kArc = 0.8;     // of the flight around it [rad]

double AngleOf(int frame) { return kArc * frame / (kFrames - 1); }

// Cameras on an arc around the z axis, looking at it horizontally.
SlidingWindow FlyAround() {
  SlidingWindow window;
  for (int i = 0; i < kFrames; ++i) {
    WindowFrame frame;
    frame.state.t_ns = 100 + i;
    const Vector3d outwards(std::cos(AngleOf(i)), std::sin(AngleOf(i)), 0);
    Eigen::Matrix3d R_W_C;
    R_W_C << Vector3d::UnitZ().cross(outwards), -Vector3d::UnitZ(), -outwards;
    frame.state.SetPose({Eigen::Quaterniond(R_W_C), kDistance * outwards});
    window.frames.push_back(frame);
  }
  return window;
}

// Position in the x-y plane at which each frame observes a vertical line 1.2 m long.
using Place = std::function<Vector2d(int frame)>;

// The right outline of a round column of this radius, observed from a frame: the tangent point of
// the line of sight.
Place OutlineOf(double radius) {
  return [radius](int frame) {
    const double side = std::acos(radius / kDistance);
    const double angle = AngleOf(frame) + side;
    return Vector2d(radius * std::cos(angle), radius * std::sin(angle));
  };
}

Place Edge() {
  return [](int) { return Vector2d(0.3, 0.4); };
}

// A shadow that moves away and returns.
Place Shadow() {
  return [](int frame) { return Vector2d(0.3, 0.4 + 0.04 * std::sin(M_PI * frame / kFrames)); };
}

LineMap Observe(const Place& place, double noise, const SlidingWindow& window, int seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, noise);
  LineMap map;
  for (int i = 0; i < kFrames; ++i) {
    const Rigid3d T_C_W = window.T_W_C(window.frames[i]).Inverse();
    LineObservation line;
    line.id = 1;
    const auto see = [&](double height) {
      const Vector2d foot = place(i);
      const Vector2d seen = (T_C_W * Vector3d(foot.x(), foot.y(), height)).hnormalized();
      return Vector2d(seen + Vector2d(normal(generator), normal(generator)));
    };
    line.start = see(-0.6);
    line.end = see(0.6);
    LineFrame frame;
    frame.t_ns = 100 + i;
    frame.lines = {line};
    map.AddFrame(frame);
  }
  return map;
}

void Triangulate(const SlidingWindow& window, LineMap* map) {
  map->Triangulate(window, LineLimits(5 * kNoise, /*max_length=*/10));
}

// Number of lines classified as wandering among this many with different noise.
int CountWandering(const Place& place, double noise, int lines) {
  const SlidingWindow window = FlyAround();
  int found = 0;
  for (int seed = 1; seed <= lines; ++seed) {
    LineMap map = Observe(place, noise, window, seed);
    Triangulate(window, &map);
    found += NoteWandering(window, kNoise, &map);
  }
  return found;
}

TEST(WanderingLines, AreOutlinesOfThickColumns) {
  EXPECT_EQ(CountWandering(OutlineOf(0.5), kNoise, 50), 50);
}

TEST(WanderingLines, AreShadowsThatMove) { EXPECT_EQ(CountWandering(Shadow(), kNoise, 50), 50); }

TEST(WanderingLines, AreNoOutlinesOfThinPipes) {
  EXPECT_EQ(CountWandering(OutlineOf(0.05), kNoise, 50), 0);
}

TEST(WanderingLines, AreNoEdgesHoweverBadlySeen) {
  EXPECT_EQ(CountWandering(Edge(), kNoise, 1000), 0);
  EXPECT_LT(CountWandering(Edge(), 4 * kNoise, 1000), 10);
}

TEST(WanderingLines, AreCountedOnceAndStayInTheWindow) {
  const SlidingWindow window = FlyAround();
  LineMap map = Observe(OutlineOf(0.5), kNoise, window, 1);
  Triangulate(window, &map);
  ASSERT_EQ(NoteWandering(window, kNoise, &map), 1);
  EXPECT_EQ(NoteWandering(window, kNoise, &map), 0);
  const LineLandmark& line = map.landmarks().at(1);
  EXPECT_TRUE(line.triangulated);
  EXPECT_FALSE(MayLast(line));
}

TEST(WanderingLines, NeedViewsThatShowATrend) {
  const SlidingWindow window = FlyAround();
  LineMap map = Observe(OutlineOf(0.5), kNoise, window, 1);
  Triangulate(window, &map);
  std::vector<LineView>& views = map.landmarks().at(1).views;
  views.erase(views.begin() + 5, views.end());
  EXPECT_EQ(NoteWandering(window, kNoise, &map), 0);
}

TEST(WanderingLines, AreOffByMoreThanNoiseAndToOneSideForLong) {
  constexpr double kVariance = 4 * kNoise * kNoise;
  EXPECT_TRUE(Wanders({kVariance, 0.1 * kVariance}, kNoise));
  EXPECT_FALSE(Wanders({kVariance, kVariance}, kNoise));
  EXPECT_FALSE(Wanders({kVariance, 0.1 * kVariance}, 2 * kNoise));
}

}  // namespace
}  // namespace plm_vins
