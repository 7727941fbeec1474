// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_merging.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/wall_scene.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using testing::LineWindow;
using testing::UniteOnWall;

TEST(LineMerging, AcceptsAnEmptyMap) {
  LineWindow window;
  EXPECT_EQ(UniteOnWall({}, &window).merging.merged, 0);
}

TEST(LineMerging, JoinsTheTracksOfOneLine) {
  LineWindow window;
  const auto counts =
      UniteOnWall({{4, {-1, 0.5}, {1, 0.6}, 0, 4}, {9, {-1, 0.5}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(counts.merging.merged, 1);
  ASSERT_EQ(window.map().lines.landmarks().size(), 1u);
  const LineLandmark& line = window.map().lines.landmarks().at(4);
  EXPECT_EQ(line.observations.size(), 10u);  // including later ones of the new track
  const PluckerLine line_W = LineInWorld(line, window.map().window);
  EXPECT_MATRIX_NEAR(Vector3d(line_W.direction.normalized().cwiseAbs()),
                     Vector3d(2, 0.1, 0).normalized(), 1e-6);
}

std::vector<LineLandmark::Observation> SeenAt(const std::vector<int64_t>& stamps) {
  std::vector<LineLandmark::Observation> observations;
  observations.reserve(stamps.size());
  for (const int64_t t_ns : stamps) observations.push_back({{t_ns, 0}, {}});
  return observations;
}

TEST(LineMerging, KeepsAnchorObservationsOfBoth) {
  LineWindow window;
  for (int i = 0; i < 10; ++i) {
    AddWallFrame({{4, {-1, 0.5}, {1, 0.6}, 0, 4}, {9, {-1, 0.5}, {1, 0.6}, 5}}, i, &window);
  }
  auto& lines = window.map().lines.landmarks();
  ASSERT_EQ(lines.size(), 2u);
  lines.at(4).anchor_observations = SeenAt({1, 4});
  lines.at(9).anchor_observations = SeenAt({2, 3, 5});
  const auto merged =
      MergeLines(LineWindow::Limits(), Eigen::Quaterniond::Identity(), &window.map());
  ASSERT_EQ(merged.counts.merged, 1);
  std::vector<int64_t> stamps;
  for (const LineLandmark::Observation& observation : lines.at(4).anchor_observations) {
    stamps.push_back(observation.t_ns);
  }
  EXPECT_EQ(stamps, (std::vector<int64_t>{1, 3, 4, 5}));  // the first one and the newest
}

TEST(LineMerging, JoinsPiecesThatTouch) {
  LineWindow window;
  const auto counts = UniteOnWall({{1, {-1, 0.5}, {0, 0.5}}, {2, {0.05, 0.5}, {1, 0.5}}}, &window);
  EXPECT_EQ(counts.merging.merged, 1);
  const auto segment = ObservedSegment(window.map().lines.landmarks().at(1), window.map().window);
  ASSERT_TRUE(segment);
}

TEST(LineMerging, NeverJoinsParallelLines) {
  for (const double distance : {0.05, 0.1, 0.2}) {
    for (const bool at_once : {true, false}) {
      LineWindow window;
      const int last = at_once ? 100 : 4;
      const auto counts =
          UniteOnWall({{1, {-1, 0.5}, {1, 0.5}, 0, last},
                       {2, {-1, 0.5 + distance}, {1, 0.5 + distance}, at_once ? 0 : 5}},
                      &window);
      EXPECT_EQ(counts.merging.merged, 0)
          << distance << (at_once ? " at once" : " one after the other");
      EXPECT_EQ(window.map().lines.landmarks().size(), 2u);
    }
  }
}

TEST(LineMerging, NeverJoinsCrossingLines) {
  LineWindow window;
  const auto counts =
      UniteOnWall({{1, {-1, 0.5}, {1, 0.5}, 0, 4}, {2, {-1, 0.4}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(counts.merging.merged, 0);
  EXPECT_EQ(window.map().lines.landmarks().size(), 2u);
}

TEST(LineMerging, NeverJoinsCollinearLinesWithAGap) {
  for (const bool at_once : {true, false}) {
    LineWindow window;
    const auto counts = UniteOnWall({{1, {-1, 0.5}, {0, 0.5}, 0, at_once ? 100 : 4},
                                     {2, {0.3, 0.5}, {1.3, 0.5}, at_once ? 0 : 5}},
                                    &window);
    EXPECT_EQ(counts.merging.merged, 0);
    EXPECT_EQ(window.map().lines.landmarks().size(), 2u);
  }
}

TEST(LineMerging, LetsOnlyOlderTracksAbsorb) {
  LineWindow window;
  UniteOnWall({{7, {-1, 0.5}, {1, 0.5}, 0, 3},
               {5, {-1, 0.5}, {1, 0.5}, 3, 6},  // triangulated later, but older by id
               {9, {-1, 0.5}, {1, 0.5}, 6}},
              &window);
  ASSERT_EQ(window.map().lines.landmarks().size(), 1u);
  EXPECT_EQ(window.map().lines.landmarks().begin()->first, 5);
  EXPECT_EQ(window.map().aliases.Resolve(9), 5);
  EXPECT_EQ(window.map().aliases.Resolve(7), 5);
}

TEST(LineMerging, DropsTheTracksOfARemovedLine) {
  LineWindow window;
  UniteOnWall({{4, {-1, 0.5}, {1, 0.6}, 0, 4}, {9, {-1, 0.5}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(window.map().aliases.Resolve(9), 4);
  window.map().lines = LineMap();
  window.Unite();
  EXPECT_EQ(window.map().aliases.Resolve(9), 9);
}

}  // namespace
}  // namespace plm_vins
