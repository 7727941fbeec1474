// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/small_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace plm_vins {
namespace {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

TEST(FactorizeCholesky, IsEigensFactor) {
  for (int i = 0; i < 100; ++i) {
    const Matrix9d half = Matrix9d::Random();
    Matrix9d matrix = half * half.transpose();
    const Matrix9d expected = Eigen::LLT<Matrix9d>(matrix).matrixL();
    ASSERT_TRUE(FactorizeCholesky(&matrix));
    const Matrix9d found = matrix.triangularView<Eigen::Lower>();
    // Versions of Eigen sum in different orders.
    EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(FactorizeCholesky, FailsWithoutPositiveDefiniteness) {
  Eigen::Matrix3d matrix = Eigen::Vector3d(1, -1e-9, 1).asDiagonal();
  EXPECT_FALSE(FactorizeCholesky(&matrix));
}

}  // namespace
}  // namespace plm_vins
