// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/geometry/level_transform.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

const LevelTransform kFirst = {2.5, {1, -2, 3}};
const LevelTransform kSecond = {1.5, {-4, 0.5, 2}};
const Eigen::Vector3d kPoint(0.3, 0.7, -0.2);

TEST(LevelTransform, TransformsPointsLikeItsRigidTransform) {
  EXPECT_TRUE((kFirst * kPoint).isApprox(kFirst.ToRigid() * kPoint, 1e-12));
}

TEST(LevelTransform, ComposesLikeRigidTransforms) {
  const LevelTransform product = kFirst * kSecond;
  EXPECT_TRUE((product * kPoint).isApprox(kFirst * (kSecond * kPoint), 1e-12));
  EXPECT_NEAR(product.yaw, 4.0 - 2 * M_PI, 1e-12);
}

TEST(LevelTransform, IsUndoneByItsInverse) {
  EXPECT_TRUE((kFirst.Inverse() * (kFirst * kPoint)).isApprox(kPoint, 1e-12));
}

TEST(LevelTransform, ConvertsToAVectorAndBack) {
  const LevelTransform back = LevelTransform::FromVector(kFirst.ToVector());
  EXPECT_EQ(back.yaw, kFirst.yaw);
  EXPECT_EQ(back.translation, kFirst.translation);
}

}  // namespace
}  // namespace plm_vins
