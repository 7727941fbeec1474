// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/so3.h"

#include <gtest/gtest.h>

#include <vector>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using testing::NumericJacobian;

// Small, medium and nearly half-turn rotations, on both sides of the series' thresholds.
std::vector<Eigen::Vector3d> RotationVectors() {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  std::vector<Eigen::Vector3d> vectors = {Eigen::Vector3d::Zero()};
  for (const double angle : {1e-12, 1e-9, 9e-7, 2e-6, 9e-6, 2e-5, 1e-3, 0.5, 2.0, 3.1}) {
    vectors.push_back(angle * axis);
  }
  return vectors;
}

TEST(SO3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 0.5, 2);
  EXPECT_MATRIX_NEAR(Skew(a) * b, a.cross(b), 1e-15);
}

TEST(SO3, ExpAgreesWithAngleAxis) {
  for (const Eigen::Vector3d& phi : RotationVectors()) {
    const Eigen::Quaterniond q = SO3Exp(phi);
    EXPECT_NEAR(q.norm(), 1, 1e-14);
    if (phi.norm() == 0) continue;
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(phi.norm(), phi.normalized()));
    EXPECT_MATRIX_NEAR(q.coeffs(), expected.coeffs(), 1e-14);
  }
}

TEST(SO3, LogInvertsExp) {
  for (const Eigen::Vector3d& phi : RotationVectors()) {
    EXPECT_MATRIX_NEAR(SO3Log(SO3Exp(phi)), phi, 1e-13);
  }
}

TEST(SO3, LogIsTheShorterRotationForBothSigns) {
  const Eigen::Quaterniond q = SO3Exp({0.3, -0.2, 0.9});
  const Eigen::Quaterniond minus_q(-q.coeffs());
  EXPECT_MATRIX_NEAR(SO3Log(minus_q), SO3Log(q), 1e-14);
  EXPECT_MATRIX_NEAR(SO3Log(SO3Exp({4, 0, 0})), Eigen::Vector3d(4 - 2 * M_PI, 0, 0), 1e-14);
}

TEST(SO3, RightJacobianIsTheDerivativeOfExp) {
  for (const Eigen::Vector3d& phi : RotationVectors()) {
    const auto difference = [&](const Eigen::Vector3d& moved) {
      return SO3Log(SO3Exp(phi).conjugate() * SO3Exp(moved));
    };
    EXPECT_MATRIX_NEAR(SO3RightJacobian(phi), NumericJacobian(difference, phi, 1e-5), 1e-9);
  }
}

TEST(SO3, RightJacobianInverseIsTheInverse) {
  for (const Eigen::Vector3d& phi : RotationVectors()) {
    EXPECT_MATRIX_NEAR(SO3RightJacobianInverse(phi) * SO3RightJacobian(phi),
                       Eigen::Matrix3d::Identity(), 1e-6);
  }
}

TEST(SO3, RightJacobianInverseIsTheDerivativeOfLog) {
  const Eigen::Vector3d phi(0.7, -1.1, 0.4);
  const auto log = [&](const Eigen::Vector3d& d) { return SO3Log(SO3Exp(phi) * SO3Exp(d)); };
  EXPECT_MATRIX_NEAR(SO3RightJacobianInverse(phi),
                     NumericJacobian(log, Eigen::Vector3d(0, 0, 0), 1e-5), 1e-9);
}

TEST(SO3, ShortestRotationTurnsOneDirectionIntoTheOther) {
  const Eigen::Vector3d from(1, 2, -0.5), to(-3, 0.1, 0.7);
  const Eigen::Quaterniond q = ShortestRotation(from, to);
  EXPECT_MATRIX_NEAR((q * from).normalized(), to.normalized(), 1e-14);
  EXPECT_NEAR(SO3Log(q).dot(from), 0, 1e-13);  // the axis is perpendicular to both
}

TEST(SO3, ShortestRotationTurnsADirectionIntoItsOpposite) {
  const Eigen::Vector3d from(1, 2, -0.5);
  EXPECT_MATRIX_NEAR(ShortestRotation(from, -2 * from) * from, -from, 1e-14);
}

TEST(SO3, YawIsTheHeading) {
  const Eigen::Quaterniond heading = SO3Exp({0, 0, 0.8});
  EXPECT_NEAR(Yaw(heading), 0.8, 1e-15);
  EXPECT_NEAR(Yaw(heading * SO3Exp({0, 0.3, 0}) * SO3Exp({0.2, 0, 0})), 0.8, 1e-15);
}

// Whatever axis of the body points up: a small tilt changes the heading by about as much at most.
TEST(SO3, YawIsWellConditionedForAnyMount) {
  for (const Eigen::Vector3d& mount :
       {Eigen::Vector3d(0, -M_PI / 2, 0), Eigen::Vector3d(0, M_PI / 2, 0),
        Eigen::Vector3d(M_PI / 2, 0, 0), Eigen::Vector3d(M_PI, 0, 0),
        Eigen::Vector3d(0, M_PI, 0)}) {
    const Eigen::Quaterniond q = SO3Exp(mount);
    for (const Eigen::Vector3d& tilt :
         {Eigen::Vector3d(0.01, 0, 0), Eigen::Vector3d(0, 0.01, 0), Eigen::Vector3d(0, 0, 0.01)}) {
      EXPECT_LT(std::abs(std::remainder(Yaw(q * SO3Exp(tilt)) - Yaw(q), 2 * M_PI)), 0.02);
    }
    const double turn = Yaw(SO3Exp({0, 0, 0.5}) * q) - Yaw(q);
    EXPECT_NEAR(std::remainder(turn, 2 * M_PI), 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace plm_vins
