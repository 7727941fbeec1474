// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/depth_slopes.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

// Points on a grid, whose inverse depths are those of a plane.
PointFrame SeePlane(const Eigen::Vector2d& slope) {
  PointFrame frame;
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10, column = i % 10;
    PointObservation point;
    point.id = i;
    point.xy = {0.1 * column - 0.45, 0.1 * row - 0.45};
    point.depth = 1 / (0.25 + slope.dot(point.xy));
    frame.points.push_back(point);
  }
  return frame;
}

TEST(DepthSlopes, AreThoseOfAPlane) {
  const Eigen::Vector2d slope(0.08, -0.05);
  for (const Eigen::Vector2d& found : DepthSlopes(SeePlane(slope))) {
    EXPECT_MATRIX_NEAR(found, slope, 1e-9);
  }
}

TEST(DepthSlopes, AreZeroBesideAnEdge) {
  PointFrame frame = SeePlane({0.08, -0.05});
  for (PointObservation& point : frame.points) {
    if (point.xy.x() > 0) *point.depth *= 1.5;
  }
  const auto slopes = DepthSlopes(frame);
  EXPECT_TRUE(slopes[54].isZero());
  EXPECT_FALSE(slopes[50].isZero());
}

TEST(DepthSlopes, AreZeroAmongFewPointsOrAlongALine) {
  PointFrame frame = SeePlane({0.08, -0.05});
  frame.points.resize(10);  // a row
  for (const Eigen::Vector2d& found : DepthSlopes(frame)) EXPECT_TRUE(found.isZero());
}

}  // namespace
}  // namespace plm_vins
