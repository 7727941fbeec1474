// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/geometry/level_transform.h"

#include <gtest/gtest.h>

#include <vector>

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

const LevelTransform kMoved = {2.5, {4, -3, 1}};

LevelTransform Fit(const std::vector<LevelTransform>& from, const std::vector<LevelTransform>& to) {
  LevelFit fit;
  for (size_t i = 0; i < from.size(); ++i) fit.Add(from[i], to[i]);
  return fit.Transform();
}

void ExpectNear(const LevelTransform& actual, const LevelTransform& expected) {
  EXPECT_LT((actual.translation - expected.translation).norm(), 1e-9);
  EXPECT_NEAR(WrapAngle(actual.yaw - expected.yaw), 0, 1e-9);
}

TEST(LevelFit, FindsACommonTransform) {
  std::vector<LevelTransform> from = {{0, {0, 0, 0}}, {1, {3, 0, 1}}, {-2, {3, 5, 0}}};
  std::vector<LevelTransform> to;
  to.reserve(from.size());
  for (const LevelTransform& frame : from) to.push_back(kMoved * frame);
  ExpectNear(Fit(from, to), kMoved);
}

TEST(LevelFit, UsesTheHeadingOfASingleFrame) {
  ExpectNear(Fit({{0.3, {1, 2, 3}}}, {kMoved * LevelTransform{0.3, {1, 2, 3}}}), kMoved);
}

TEST(LevelFit, IsTheIdentityWithoutPairs) { ExpectNear(Fit({}, {}), LevelTransform()); }

// The distance of two frames has decreased: their midpoint stays, so both move equally.
TEST(LevelFit, AveragesResiduals) {
  const LevelTransform T = Fit({{0, {-1, 0, 0}}, {0, {1, 0, 0}}}, {{0, {0, 0, 0}}, {0, {1, 0, 0}}});
  ExpectNear(T, {0, {0.5, 0, 0}});
}

}  // namespace

}  // namespace plm_vins
