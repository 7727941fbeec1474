// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph/level_edge.h"

#include <gtest/gtest.h>

#include <functional>

namespace plm_vins {
namespace {

LevelEdge EdgeWith(const LevelTransform& T_from_to, double variance) {
  Matrix4d root;
  root << 2, 0, 0.3, 0, 0.1, 1, 0, -0.2, 0, 0, 3, 0, 0.4, 0, 0, 0.5;
  return {1, 2, T_from_to, variance * root * root.transpose(), false, 5};
}

// Numeric Jacobian of a function of T as (x, y, z, yaw).
Matrix4d Jacobian(const std::function<LevelTransform(const LevelTransform&)>& function,
                  const LevelTransform& T) {
  constexpr double kStep = 1e-6;
  Matrix4d J;
  for (int i = 0; i < 4; ++i) {
    const Vector4d step = kStep * Vector4d::Unit(i);
    const auto at = [&](const Vector4d& v) { return function(LevelTransform::FromVector(v)); };
    J.col(i) = EdgeError(at(T.ToVector() + step), at(T.ToVector() - step)) / (2 * kStep);
  }
  return J;
}

const LevelTransform kFirst = {0.7, {1, -2, 0.5}};
const LevelTransform kSecond = {-2.1, {0.3, 4, -1}};

TEST(LevelEdge, ReversedHasTheInverseAndItsCovariance) {
  const LevelEdge edge = EdgeWith(kFirst, 0.01);
  const LevelEdge reversed = Reversed(edge);
  EXPECT_EQ(reversed.from, 2);
  EXPECT_EQ(reversed.to, 1);
  EXPECT_EQ(reversed.way, 5);
  EXPECT_LT(EdgeError(reversed.T_from_to * kFirst, LevelTransform()).norm(), 1e-12);
  const Matrix4d J = Jacobian([](const LevelTransform& T) { return T.Inverse(); }, kFirst);
  EXPECT_LT((reversed.covariance - J * edge.covariance * J.transpose()).norm(), 1e-8);
}

TEST(LevelEdge, ChainedAddsBothCovariances) {
  const LevelEdge first = EdgeWith(kFirst, 0.01);
  LevelEdge second = EdgeWith(kSecond, 0.02);
  second.from = 2;
  second.to = 7;
  second.is_loop = true;
  const LevelEdge chained = Chained(first, second);
  EXPECT_EQ(chained.from, 1);
  EXPECT_EQ(chained.to, 7);
  EXPECT_TRUE(chained.is_loop);
  EXPECT_EQ(chained.way, 10);
  const Matrix4d J1 = Jacobian([](const LevelTransform& T) { return T * kSecond; }, kFirst);
  const Matrix4d J2 = Jacobian([](const LevelTransform& T) { return kFirst * T; }, kSecond);
  const Matrix4d expected =
      J1 * first.covariance * J1.transpose() + J2 * second.covariance * J2.transpose();
  EXPECT_LT((chained.covariance - expected).norm(), 1e-8);
}

TEST(Deviations, AreThoseOfTheCovariance) {
  const Vector4d deviations(0.1, 0.1, 0.1, 0.01);
  EXPECT_NEAR(Deviations({0.3, 0, 0, 0.04}, deviations.cwiseAbs2().asDiagonal()), 5, 1e-9);
}

}  // namespace
}  // namespace plm_vins
