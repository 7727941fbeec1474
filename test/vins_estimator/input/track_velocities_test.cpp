// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/track_velocities.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

PointFrame Frame(int64_t t_ms, int64_t id, double x, double y) {
  PointFrame frame;
  frame.t_ns = t_ms * 1'000'000;
  frame.points.push_back({id, {x, y}, {0, 0}, {9, 9}});
  return frame;
}

TEST(TrackVelocities, AreDifferencesToThePreviousImage) {
  TrackVelocities velocities;
  PointFrame first = Frame(100, 1, 0.5, 0), second = Frame(150, 1, 0.6, -0.2);
  velocities.Fill(&first);
  EXPECT_TRUE(first.points[0].velocity.isZero(0));
  velocities.Fill(&second);
  EXPECT_TRUE(second.points[0].velocity.isApprox(Eigen::Vector2d(2, -4)));
}

TEST(TrackVelocities, AreZeroForNewTracksAfterGapsAndWhereTimeGoesBack) {
  TrackVelocities velocities;
  PointFrame first = Frame(100, 1, 0.5, 0);
  velocities.Fill(&first);
  for (PointFrame next : {Frame(150, 2, 0, 0), Frame(200, 1, 0, 0), Frame(1300, 1, 1, 0),
                          Frame(1250, 1, 0, 0), Frame(1251, 1, 50, 0)}) {
    velocities.Fill(&next);
    EXPECT_TRUE(next.points[0].velocity.isZero(0)) << next.t_ns;
  }
}

}  // namespace
}  // namespace plm_vins
