// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/epipolar_constraint.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

TEST(EpipolarGradient, IsTheDerivative) {
  simulator::Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Vector3d f0 = random.NormalVector3(), f1 = random.NormalVector3();
    const Vector3d t = random.NormalVector3().normalized();
    const Eigen::Matrix3d R = SO3Exp(random.NormalVector3()).toRotationMatrix();
    const auto basis = TangentBasis(t);
    const double weight = 1.7;
    const auto constraint = [&](const Eigen::Matrix<double, 5, 1>& delta) {
      const Vector3d a = SO3Exp(delta.head<3>()) * Vector3d(R * f0);
      const Vector3d moved = t + basis * delta.tail<2>();
      return Eigen::VectorXd::Constant(1, weight * moved.dot(a.cross(f1)));
    };
    const Eigen::Matrix<double, 5, 1> zero = Eigen::Matrix<double, 5, 1>::Zero();
    const Eigen::MatrixXd numeric = testing::NumericJacobian(constraint, zero);
    EXPECT_MATRIX_NEAR(EpipolarGradient(weight, R * f0, f1, t, basis).transpose(), numeric, 1e-7);
  }
}

}  // namespace
}  // namespace plm_vins
