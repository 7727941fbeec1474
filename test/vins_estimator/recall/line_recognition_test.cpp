// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/recall/line_recognition.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "test/vins_estimator/wall_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using testing::LineWindow;
using testing::UniteOnWall;

// A line that leaves the window, and one of a new track afterwards.
constexpr int64_t kGone = 4, kComeBack = 9;
constexpr int kFramesAndBack = 30;

UnitedLines ComeBack(const Vector2d& start, const Vector2d& end, LineWindow* window) {
  return UniteOnWall({{kGone, {-1, 0.5}, {1, 0.5}, 0, 7}, {kComeBack, start, end, 20}}, window,
                     kFramesAndBack);
}

TEST(LineRecognition, RecognizesAReobservedLine) {
  LineWindow window;
  const auto counts = ComeBack({-1, 0.5}, {1, 0.5}, &window);
  EXPECT_EQ(counts.recognized, 1);
  EXPECT_EQ(counts.merging.merged, 0);
  EXPECT_EQ(window.map().aliases.Resolve(kComeBack), kGone);
  ASSERT_EQ(window.map().lines.landmarks().size(), 1u);
  const LineLandmark& line = window.map().lines.landmarks().at(kGone);
  EXPECT_EQ(line.id, kGone);
  EXPECT_EQ(line.observations.size(), 10u);  // including later ones of the new track
  ASSERT_EQ(line.anchor_observations.size(), 1u);
  EXPECT_EQ(line.anchor_observations[0].t_ns, 100'000'000);
  const AnchorFrame& anchor = window.map().window.AnchorAt(line.anchor_observations[0].t_ns);
  EXPECT_EQ(anchor.last_use_ns, window.map().window.newest().state.t_ns);
}

TEST(LineRecognition, RecognizesAnotherPartOfALine) {
  LineWindow window;
  EXPECT_EQ(ComeBack({1.05, 0.5}, {2, 0.5}, &window).recognized, 1);
  EXPECT_EQ(window.map().lines.landmarks().count(kGone), 1u);
}

TEST(LineRecognition, DoesNotConfuseLines) {
  const std::map<std::string, std::pair<Vector2d, Vector2d>> others = {
      {"parallel", {{-1, 0.7}, {1, 0.7}}},
      {"crossing", {{-1, 0.4}, {1, 0.6}}},
      {"collinear with a gap", {{1.3, 0.5}, {3, 0.5}}}};
  for (const auto& [name, ends] : others) {
    LineWindow window;
    EXPECT_EQ(ComeBack(ends.first, ends.second, &window).recognized, 0) << name;
    EXPECT_NE(window.map().memory.Find(kGone), nullptr);
    ASSERT_EQ(window.map().lines.landmarks().size(), 1u);
    const LineLandmark& line = window.map().lines.landmarks().at(kComeBack);
    EXPECT_TRUE(line.triangulated);
    EXPECT_TRUE(line.anchor_observations.empty());
  }
}

// The distance of the two is below the limits, but images show them side by side.
TEST(LineRecognition, DoesNotRecognizeAnObservedLine) {
  LineWindow window;
  const auto counts = UniteOnWall(
      {{kGone, {-1, 0.5}, {1, 0.5}}, {kComeBack, {-1, 0.54}, {1, 0.54}, 14}}, &window, 22);
  EXPECT_NE(window.map().memory.Find(kGone), nullptr);
  EXPECT_EQ(counts.recognized, 0);
  EXPECT_EQ(window.map().lines.landmarks().size(), 2u);
}

TEST(LineRecognition, MergesTheNextTrackIntoARecognizedLine) {
  LineWindow window;
  const auto counts = UniteOnWall({{kGone, {-1, 0.5}, {1, 0.5}, 0, 7},
                                   {kComeBack, {-1, 0.5}, {1, 0.5}, 20, 24},
                                   {kComeBack + 1, {-1, 0.5}, {1, 0.5}, 25}},
                                  &window, kFramesAndBack);
  EXPECT_EQ(counts.recognized, 1);
  EXPECT_EQ(counts.merging.merged, 1);
  EXPECT_EQ(window.map().aliases.Resolve(kComeBack + 1), kGone);
}

}  // namespace
}  // namespace plm_vins
