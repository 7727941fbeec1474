// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/segments/line_segment.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

LineSegment AtAngle(double degrees) {
  const double angle = degrees * M_PI / 180;
  return {{1, 2}, {1 + 3 * std::cos(angle), 2 + 3 * std::sin(angle)}};
}

TEST(LineSegmentTest, DistanceIsSignedAndPositionCountsFromTheStart) {
  const LineSegment segment{{1, 1}, {5, 1}};
  EXPECT_DOUBLE_EQ(segment.Length(), 4);
  EXPECT_DOUBLE_EQ(segment.Distance({3, 3}), 2);
  EXPECT_DOUBLE_EQ(segment.Distance({30, -1}), -2);
  EXPECT_DOUBLE_EQ(segment.Along({4, 7}), 3);
  EXPECT_DOUBLE_EQ(segment.Reversed().Distance({3, 3}), -2);
}

TEST(LineSegmentTest, AnglesWrap) {
  const double degree = M_PI / 180;
  EXPECT_NEAR(DirectedAngle(AtAngle(179), AtAngle(-179)), 2 * degree, 1e-12);
  EXPECT_NEAR(DirectedAngle(AtAngle(10), AtAngle(190)), 180 * degree, 1e-12);
}

TEST(LineSegmentTest, RelationOfSegmentsSideBySide) {
  const LineSegment a{{0, 0}, {10, 0}};
  for (const LineSegment& b : {LineSegment{{6, 2}, {14, 2}}, LineSegment{{14, 2}, {6, 2}}}) {
    const SegmentRelation relation = Relate(a, b);
    EXPECT_DOUBLE_EQ(relation.overlap, 0.5);  // 4 of 8
    EXPECT_DOUBLE_EQ(relation.distance, 2);
  }
  EXPECT_LT(Relate(a, {{12, 0}, {20, 0}}).overlap, 0);
  EXPECT_DOUBLE_EQ(Relate(a, {{4, 0}, {6, 0}}).overlap, 1);
  EXPECT_DOUBLE_EQ(Relate(a, {{0, -1}, {10, 3}}).distance, 1);  // in the middle
  EXPECT_DOUBLE_EQ(Relate(a, {{0, 0}, {20, 4}}).distance, 1);   // in the middle of the shared part
}

}  // namespace
}  // namespace plm_vins
