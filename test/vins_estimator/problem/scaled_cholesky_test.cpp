// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/scaled_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace plm_vins {
namespace {

// Positive definite, with scales from 1e-4 to 1e8 on its diagonal.
Eigen::Matrix3d BadlyScaled() {
  const Eigen::Vector3d scale(1e-2, 1, 1e4);
  Eigen::Matrix3d S;
  S << 2, 1, 0.5, 1, 3, -1, 0.5, -1, 4;
  return scale.asDiagonal() * S * scale.asDiagonal();
}

TEST(ScaledCholesky, Solves) {
  const Eigen::Matrix3d S = BadlyScaled();
  const Eigen::Vector3d x(30, -0.5, 2e-4);
  const ScaledCholesky factors(S);
  ASSERT_TRUE(factors.success());
  const Eigen::VectorXd solution = factors.Solve(S * x);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(solution[i] / x[i], 1, 1e-12);
}

TEST(ScaledCholesky, GivesABlockOfTheInverseInTheOrderAsked) {
  const Eigen::Matrix3d inverse = BadlyScaled().inverse();
  const Eigen::MatrixXd block = ScaledCholesky(BadlyScaled()).InverseBlock({2, 0});
  ASSERT_EQ(block.rows(), 2);
  ASSERT_EQ(block.cols(), 2);
  EXPECT_NEAR(block(0, 0) / inverse(2, 2), 1, 1e-9);
  EXPECT_NEAR(block(0, 1) / inverse(2, 0), 1, 1e-9);
  EXPECT_NEAR(block(1, 1) / inverse(0, 0), 1, 1e-9);
}

TEST(ScaledCholesky, TellsWhatIsNotPositiveDefinite) {
  Eigen::Matrix3d S = BadlyScaled();
  S(0, 1) = S(1, 0) = 1;
  EXPECT_FALSE(ScaledCholesky(S).success());
}

}  // namespace
}  // namespace plm_vins
