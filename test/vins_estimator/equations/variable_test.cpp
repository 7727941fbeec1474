// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/variable.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "common/camera/camera_model.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"

namespace plm_vins {
namespace {

constexpr BlockKind kKinds[] = {BlockKind::kPose,       BlockKind::kMotion, BlockKind::kExtrinsic,
                                BlockKind::kTimeOffset, BlockKind::kPoint,  BlockKind::kLine,
                                BlockKind::kIntrinsics};

// Values well inside the domain of every kind.
Eigen::VectorXd SomeValues(BlockKind kind, simulator::Random* random) {
  Eigen::VectorXd values = testing::NormalVector(VariableTypeOf(kind).ambient_size, random);
  if (values.size() == 7) values.tail<4>().normalize();
  if (kind == BlockKind::kPoint) values[2] = 5.0;
  if (kind == BlockKind::kIntrinsics) values.head<4>().array() += 400;
  if (kind == BlockKind::kLine) {
    values.head<4>().normalize();
    values[4] = 0.5;
  }
  return values;
}

TEST(Variable, MinusInvertsPlus) {
  simulator::Random random(1);
  for (const BlockKind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    const VariableType& type = VariableTypeOf(kind);
    ASSERT_LE(type.ambient_size, kMaxAmbientSize);
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd x = SomeValues(kind, &random);
      const Eigen::VectorXd delta = 0.3 * testing::NormalVector(type.tangent_size, &random);
      Eigen::VectorXd y(type.ambient_size), back(type.tangent_size);
      type.plus(x.data(), delta.data(), y.data());
      type.minus(y.data(), x.data(), back.data());
      EXPECT_MATRIX_NEAR(back, delta, 1e-12);
    }
  }
}

TEST(Variable, PlusMayWriteOverItsInput) {
  simulator::Random random(2);
  for (const BlockKind kind : kKinds) {
    const VariableType& type = VariableTypeOf(kind);
    Eigen::VectorXd x = SomeValues(kind, &random);
    const Eigen::VectorXd delta = testing::NormalVector(type.tangent_size, &random);
    Eigen::VectorXd expected(type.ambient_size);
    type.plus(x.data(), delta.data(), expected.data());
    type.plus(x.data(), delta.data(), x.data());
    EXPECT_MATRIX_NEAR(x, expected, 0.0);
  }
}

TEST(Variable, LinesHaveFourDegreesOfFreedom) {
  EXPECT_EQ(&VariableTypeOf(BlockKind::kLine), &LineVariable());
  EXPECT_EQ(LineVariable().ambient_size, 5);
  EXPECT_EQ(LineVariable().tangent_size, 4);
}

TEST(Variable, PointsStayInFrontOfTheirHost) {
  const Eigen::Vector3d point(0.1, 0.2, 0.5);
  for (const double step : {-0.5, -0.6, -100.0}) {
    const Eigen::Vector3d delta(0.3, 0.4, step);
    Eigen::Vector3d moved;
    PointVariable().plus(point.data(), delta.data(), moved.data());
    EXPECT_GT(moved[2], 0) << step;
    EXPECT_MATRIX_NEAR(moved.head<2>(), Eigen::Vector2d(0.4, 0.6), 1e-15);
  }
}

TEST(Variable, DistantPointIsNotPulledCloser) {
  const Eigen::Vector3d point(0.1, 0.2, 1.0 / 2000);
  Eigen::Vector3d moved;
  for (const double step : {0.0, -1e-5, -1.0}) {
    const Eigen::Vector3d delta(0, 0, step);
    PointVariable().plus(point.data(), delta.data(), moved.data());
    EXPECT_EQ(moved, point) << step;
  }
  const Eigen::Vector3d nearer(0, 0, 1e-4);
  PointVariable().plus(point.data(), nearer.data(), moved.data());
  EXPECT_NEAR(moved[2], 6e-4, 1e-15);
}

TEST(Variable, FocalLengthsStayPositive) {
  Intrinsics intrinsics;
  intrinsics << 400, 401, 320, 240, 0.1, 0.2, 0.3, 0.4;
  Intrinsics step = Intrinsics::Ones();
  step.head<2>() << -500, -401;
  Intrinsics moved;
  IntrinsicsVariable().plus(intrinsics.data(), step.data(), moved.data());
  EXPECT_GT(moved[0], 0);
  EXPECT_GT(moved[1], 0);
  EXPECT_MATRIX_NEAR(moved.tail<6>(), (intrinsics + step).tail<6>(), 1e-12);
}

}  // namespace
}  // namespace plm_vins
