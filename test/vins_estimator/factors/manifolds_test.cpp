// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/factors/manifolds.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Pose = Eigen::Matrix<double, 7, 1>;
using Tangent = Eigen::Matrix<double, 6, 1>;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Pose Plus(const Pose& x, const Tangent& delta) {
  Pose result;
  PosePlus(x.data(), delta.data(), result.data());
  return result;
}

Tangent Minus(const Pose& y, const Pose& x) {
  Tangent result;
  PoseMinus(y.data(), x.data(), result.data());
  return result;
}

Quaterniond Rotation(const Pose& x) { return Quaterniond(x.tail<4>()); }

Tangent RandomTangent(simulator::Random* random, double scale) {
  Tangent result;
  result << random->UniformInBox(Vector3d::Constant(scale)),
      random->UniformInBox(Vector3d::Constant(scale));
  return result;
}

Pose RandomUnitPose(simulator::Random* random) {
  Pose identity;
  identity << 0, 0, 0, 0, 0, 0, 1;
  return Plus(identity, RandomTangent(random, 1.7));
}

TEST(PoseManifold, PlusZeroIsNeutral) {
  simulator::Random random(1);
  const Pose x = RandomUnitPose(&random);
  EXPECT_MATRIX_NEAR(Plus(x, Tangent::Zero()), x, 1e-15);
  EXPECT_MATRIX_NEAR(Minus(x, x), Tangent::Zero(), 1e-15);
}

TEST(PoseManifold, MinusInvertsPlus) {
  simulator::Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose x = RandomUnitPose(&random);
    const Tangent delta = RandomTangent(&random, i % 2 == 0 ? 1.7 : 1e-9);  // below pi, and tiny
    EXPECT_MATRIX_NEAR(Minus(Plus(x, delta), x), delta, 1e-12);
    const Pose y = RandomUnitPose(&random);
    const Pose back = Plus(x, Minus(y, x));
    EXPECT_MATRIX_NEAR(back.head<3>(), y.head<3>(), 1e-12);
    EXPECT_LT(Rotation(back).angularDistance(Rotation(y)), 1e-7);
    EXPECT_NEAR(Rotation(back).norm(), 1.0, 1e-15);
  }
}

TEST(PoseManifold, PerturbsTheRotationOnTheRight) {
  simulator::Random random(3);
  const Pose x = RandomUnitPose(&random);
  Tangent delta;
  delta << 1, 2, 3, 0.1, -0.2, 0.3;
  const Pose y = Plus(x, delta);
  EXPECT_MATRIX_NEAR(y.head<3>(), x.head<3>() + Vector3d(1, 2, 3), 1e-15);
  EXPECT_LT(Rotation(y).angularDistance(Rotation(x) * SO3Exp({0.1, -0.2, 0.3})), 1e-7);
}

TEST(PoseManifold, QuaternionsOfOppositeSignAreEqual) {
  simulator::Random random(4);
  const Pose x = RandomUnitPose(&random);
  const Tangent delta = RandomTangent(&random, 0.1);
  Pose y = Plus(x, delta);
  y.tail<4>() *= -1;
  EXPECT_MATRIX_NEAR(Minus(y, x), delta, 1e-12);
}

TEST(PoseManifold, PlusMayWriteOverItsInput) {
  simulator::Random random(5);
  Pose x = RandomUnitPose(&random);
  const Tangent delta = RandomTangent(&random, 1.0);
  const Pose expected = Plus(x, delta);
  PosePlus(x.data(), delta.data(), x.data());
  EXPECT_MATRIX_NEAR(x, expected, 0.0);
}

}  // namespace
}  // namespace plm_vins
