// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/segment_merging.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

const SegmentMergingLimits kLimits;  // a gap of 12, a distance of 1.5

TEST(SegmentMergingTest, JoinsAChainFromItsMiddle) {
  const std::vector<LineSegment> chain = {
      {{0, 0}, {20, 0.3}}, {{26, 0}, {57, 0}}, {{60, -0.3}, {90, 0.2}}, {{98, 0}, {130, 0}}};
  const auto joined = JoinFragments(chain, kLimits);
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_NEAR(joined[0].Length(), 130, 1e-9);
}

TEST(SegmentMergingTest, JoinsUprightLines) {  // the angle wraps at vertical lines
  const auto joined = JoinFragments({{{5, 0}, {5.2, 30}}, {{5.3, 35}, {5.1, 65}}}, kLimits);
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_NEAR(joined[0].Length(), 65, 0.01);
}

TEST(SegmentMergingTest, KeepsOtherLines) {
  const LineSegment base{{0, 0}, {40, 0}};
  const std::vector<LineSegment> others = {
      {{43, 4}, {80, 4}},     // parallel
      {{43, 0}, {43, 40}},    // around a corner
      {{43, 0.5}, {80, 6}},   // bent
      {{60, 0}, {100, 0}},    // too far
      {{20, -20}, {20, 20}},  // crossing
      {{0, 3}, {40, 3}},      // side by side
      {{80, 0}, {43, 0}},     // of the opposite direction
  };
  for (const LineSegment& other : others)
    EXPECT_EQ(JoinFragments({base, other}, kLimits).size(), 2U) << other.start.transpose();
}

TEST(SegmentMergingTest, KeepsAllOfAThousandLines) {
  std::vector<LineSegment> fragments;
  for (int row = 0; row < 1000; ++row) {
    const double y = 5.0 * row;
    fragments.push_back({{0, y}, {30, y}});
    fragments.push_back({{35, y}, {60, y}});
  }
  const auto joined = JoinFragments(fragments, kLimits);
  EXPECT_EQ(joined.size(), 1000U);
  for (const LineSegment& line : joined) EXPECT_NEAR(line.Length(), 60, 1e-9);
}

TEST(SegmentMergingTest, NoSegmentsGiveNone) { EXPECT_TRUE(JoinFragments({}, kLimits).empty()); }

}  // namespace
}  // namespace plm_vins
