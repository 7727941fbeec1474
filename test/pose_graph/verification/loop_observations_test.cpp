// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_observations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

TEST(Viewpoint, DistanceToPointsBehindTheCameraIsInfinite) {
  const Viewpoint viewpoint(LevelTransform(), testing::LookingAhead().rotation);
  EXPECT_NEAR(viewpoint.Error({{2, 0, 0}, {0.1, 0}}), 0.1, 1e-12);
  EXPECT_TRUE(std::isinf(viewpoint.Error({{-2, 0, 0}, {0.1, 0}})));
}

TEST(Viewpoint, MeasuresTheReprojectionError) {
  const Eigen::Quaterniond R_G_C = testing::LookingAhead().rotation;
  const LevelTransform T_O_G = {0.7, {1, 2, 3}};
  const Eigen::Vector3d p_C(0.4, -0.2, 4);
  const SeenPoint observation = {T_O_G * (R_G_C * p_C),
                                 p_C.hnormalized() + Eigen::Vector2d(0.03, 0.04)};
  const Viewpoint viewpoint(T_O_G, R_G_C);
  EXPECT_NEAR(viewpoint.Error(observation), 0.05, 1e-12);
  const Eigen::Vector3d seen_C = R_G_C.conjugate() * (T_O_G.Inverse() * observation.p_O);
  EXPECT_EQ(viewpoint.Error(observation), (seen_C.hnormalized() - observation.xy).norm());
}

}  // namespace
}  // namespace plm_vins
