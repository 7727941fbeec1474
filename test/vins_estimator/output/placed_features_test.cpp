// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/placed_features.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(PlaceCorners, GivesEachTheLandmarkOfItsTrack) {
  PointFrame frame;
  frame.points.resize(2);
  frame.points[0].id = 4;
  frame.points[1].id = 7;
  const auto corners = PlaceCorners(frame, {{7, {1, 2, 3}}, {9, {4, 5, 6}}});
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_FALSE(corners[0].p_O);
  EXPECT_EQ(corners[1].observation.id, 7);
  EXPECT_EQ(*corners[1].p_O, Eigen::Vector3d(1, 2, 3));
}

TEST(PlaceSegments, GivesEachTheLandmarkOfItsTrack) {
  LineFrame frame;
  frame.lines.resize(2);
  frame.lines[0].id = 4;
  frame.lines[1].id = 7;
  const auto segments = PlaceSegments(frame, {{4, {1, 2, 3}, {4, 5, 6}}});
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].landmark->end_O, Eigen::Vector3d(4, 5, 6));
  EXPECT_FALSE(segments[1].landmark);
}

}  // namespace
}  // namespace plm_vins
