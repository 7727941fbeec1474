// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/rigid3.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

const Rigid3d T_A_B(SO3Exp({0.3, -1.2, 0.4}), {1, -2, 3});
const Rigid3d T_B_C(SO3Exp({-0.9, 0.1, 2.0}), {0.5, 0.25, -4});
const Eigen::Vector3d p_C(0.1, 7, -2);

TEST(Rigid3, IdentityByDefault) { EXPECT_EQ(Rigid3d() * p_C, p_C); }

TEST(Rigid3, TurnsThenMoves) {
  const Rigid3d quarter_turn(SO3Exp({0, 0, M_PI / 2}), {10, 0, 0});
  EXPECT_MATRIX_NEAR(quarter_turn * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(10, 1, 0), 1e-14);
}

TEST(Rigid3, ProductAppliesTheRightFactorFirst) {
  EXPECT_MATRIX_NEAR((T_A_B * T_B_C) * p_C, T_A_B * (T_B_C * p_C), 1e-13);
}

TEST(Rigid3, InverseUndoes) {
  EXPECT_MATRIX_NEAR(T_A_B.Inverse() * (T_A_B * p_C), p_C, 1e-13);
  const Rigid3d identity = T_A_B * T_A_B.Inverse();
  EXPECT_MATRIX_NEAR(identity.R(), Eigen::Matrix3d::Identity(), 1e-14);
  EXPECT_MATRIX_NEAR(identity.translation, Eigen::Vector3d::Zero(), 1e-14);
}

TEST(Rigid3, LongProductsStayUnitLength) {
  Rigid3d product;
  for (int i = 0; i < 10000; ++i) product = product * T_A_B;
  EXPECT_NEAR(product.rotation.norm(), 1, 1e-15);
}

}  // namespace
}  // namespace plm_vins
