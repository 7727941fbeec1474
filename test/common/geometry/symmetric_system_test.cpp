// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_system.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

template <int kSize>
void ExpectSolution() {
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  Matrix root = Matrix::Identity();
  root.row(kSize - 1).setLinSpaced(-0.7, 1.9);
  const Matrix A = root.transpose() * root;
  const Vector x = Vector::LinSpaced(1, -2), b = A * x;
  EXPECT_MATRIX_NEAR(SolveSymmetric(A, b), x, 1e-12);
}

TEST(SymmetricSystem, IsSolvedForEverySize) {
  ExpectSolution<3>();
  ExpectSolution<4>();
  ExpectSolution<5>();
  ExpectSolution<6>();
}

TEST(SymmetricSystem, IsInverted) {
  const Eigen::Matrix3d A = Eigen::Vector3d(1, 0, -2) * Eigen::RowVector3d(1, 0, -2) +
                            Eigen::Matrix3d(Eigen::Vector3d(3, 4, 5).asDiagonal());
  EXPECT_MATRIX_NEAR(InverseOfSymmetric(A) * A, Eigen::Matrix3d::Identity(), 1e-12);
}

TEST(SymmetricSystem, InverseOfCholeskyFactorWhitens) {
  Eigen::MatrixXd A(3, 3);
  A << 4, 2, -1, 2, 5, 0, -1, 0, 3;
  const auto W = InverseCholeskyFactor(A);
  ASSERT_TRUE(W);
  EXPECT_MATRIX_NEAR(*W * A * W->transpose(), Eigen::Matrix3d::Identity(), 1e-12);
  A(2, 2) = 0;
  EXPECT_FALSE(InverseCholeskyFactor(A));
}

}  // namespace
}  // namespace plm_vins
