// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_pairs.h"

#include <gtest/gtest.h>

#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using Pairs = std::vector<std::pair<size_t, size_t>>;

TEST(FindNearPairs, AcceptsAnEmptyInput) {
  EXPECT_TRUE(FindNearPairs({}, 0.1).empty());
  EXPECT_TRUE(FindNearPairs({{{0, 0, 0}, {1, 0, 0}}}, 0.1).empty());
}

TEST(FindNearPairs, FindsLinesWhoseBoxesAreNear) {
  const std::vector<SeenLine> lines = {{{0, 0, 0}, {2, 0, 0}},
                                       {{5, 0, 0}, {6, 0, 0}},
                                       {{1, 0.09, 0}, {3, 0.09, 0}},
                                       {{0, 0, 0.11}, {2, 0, 0.11}},
                                       {{6.05, 0, 0}, {6.05, 0, 9}}};
  EXPECT_EQ(FindNearPairs(lines, 0.1), (Pairs{{2, 0}, {4, 1}}));
}

// The sweep finds the same pairs as a comparison of all pairs.
TEST(FindNearPairs, MissesNone) {
  simulator::Random random(1);
  std::vector<SeenLine> lines;
  for (int i = 0; i < 200; ++i) {
    const Vector3d start = random.UniformInBox({5, 5, 2});
    lines.push_back({start, start + 0.5 * random.NormalVector3()});
  }
  const auto box = [](const SeenLine& line) {
    return Eigen::AlignedBox3d(line.start_F.cwiseMin(line.end_F),
                               line.start_F.cwiseMax(line.end_F));
  };
  Pairs expected;
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Vector3d gap = (box(lines[i]).min() - box(lines[j]).max())
                               .cwiseMax(box(lines[j]).min() - box(lines[i]).max());
      if (gap.maxCoeff() <= 0.1) expected.push_back({i, j});
    }
  }
  EXPECT_GT(expected.size(), 20u);
  EXPECT_EQ(FindNearPairs(lines, 0.1), expected);
}

TEST(Compare, MeasuresAngleDistanceAndGap) {
  const SeenLine a{{0, 0, 0}, {2, 0, 0}};
  const LinePairGeometry beside = Compare(a, {{3, 0.1, 0}, {1, 0.1, 0}});
  EXPECT_NEAR(beside.angle, 0, 1e-12);
  EXPECT_NEAR(beside.distance, 0.1, 1e-12);
  EXPECT_NEAR(beside.gap, -1, 1e-12);
  const LinePairGeometry behind = Compare(a, {{2.5, 0, 0}, {4, 0, 0}});
  EXPECT_NEAR(behind.distance, 0, 1e-12);
  EXPECT_NEAR(behind.gap, 0.5, 1e-12);
  EXPECT_NEAR(Compare(a, {{0, 0, 0}, {0, -1, 1}}).angle, M_PI / 2, 1e-12);
}

// Two pieces of an edge, each slightly rotated by noise: along their axis they are one line.
TEST(Compare, MeasuresAlongTheAxisOfBoth) {
  SeenLine a{{0, 0, 0}, {2, 0.06, 0}}, b{{2, 0.06, 0}, {4, 0, 0}};
  a.axis = b.axis = LineAxis::kX;
  EXPECT_NEAR(Compare(a, b).distance, 0, 1e-12);
  b.start_F.y() = b.end_F.y() = 0.2;
  EXPECT_NEAR(Compare(a, b).distance, 0.17, 1e-12);
}

}  // namespace
}  // namespace plm_vins
