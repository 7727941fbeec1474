// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/state/derived_covariance.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

FrameState SomeState(const Vector3d& p_W) {
  FrameState state;
  state.SetPose({SO3Exp({0.3, -0.8, 1.2}), p_W});
  state.velocity() = Vector3d(4, -1, 2);
  return state;
}

// Pose covariance if the only error is a world rotation of 0.02 rad about the vertical through
// `origin_W`.
Matrix6d TurnedAbout(const Vector3d& origin_W, const FrameState& state) {
  Vector6d error;
  error << Vector3d::UnitZ().cross(state.position() - origin_W),
      state.rotation().conjugate() * Vector3d::UnitZ();
  return 0.02 * 0.02 * error * error.transpose();
}

TEST(DerivedCovariance, HeadingDriftOfTheWorldIsNoPathDrift) {
  const Vector3d origin(0, 0, 1), pivot(300, 40, 5);
  const double at_pivot =
      PositionVarianceFrom(pivot, SomeState(pivot), TurnedAbout(origin, SomeState(pivot)));
  EXPECT_NEAR(at_pivot, 0.02 * 0.02 * (300 * 300 + 40 * 40), 1e-6);
  for (const Vector3d& way : {Vector3d(20, 0, 0), Vector3d(-90, 3, 2), Vector3d(5, -80, 0)}) {
    const FrameState there = SomeState(pivot + way);
    EXPECT_NEAR(PositionVarianceFrom(pivot, there, TurnedAbout(origin, there)), at_pivot, 1e-6);
  }
}

TEST(DerivedCovariance, PathDriftCounts) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>() << 0.1, 0.2, 0.3;
  EXPECT_NEAR(PositionVarianceFrom({7, 8, 9}, SomeState({1, 2, 3}), covariance), 0.6, 1e-12);
}

TEST(DerivedCovariance, BodyVelocityCovarianceMatchesErrors) {
  const FrameState state = SomeState({1, 2, 3});
  const auto v_B = [&state](const Vector6d& error) -> Eigen::VectorXd {
    const Eigen::Quaterniond R_W_B = state.rotation() * SO3Exp(error.head<3>());
    return R_W_B.conjugate() * (state.velocity() + error.tail<3>());
  };
  const Eigen::MatrixXd J = testing::NumericJacobian(v_B, Vector6d(Vector6d::Zero()));
  Matrix6d L = Matrix6d::Random();
  const Matrix6d covariance = L * L.transpose();
  EXPECT_MATRIX_NEAR(BodyVelocityCovariance(state, covariance), J * covariance * J.transpose(),
                     1e-6);
}

TEST(DerivedCovariance, AnUnknownScaleMovesPositionsAndVelocities) {
  const FrameState state = SomeState({3, 4, 0});
  StateUncertainty known = {Matrix6d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(),
                            Matrix6d::Zero()};
  AddScaleDeviation(0.1, state, &known);
  EXPECT_NEAR(std::sqrt(known.pose.trace()), 0.5, 1e-12);
  EXPECT_NEAR(std::sqrt(known.velocity.trace()), 0.1 * state.velocity().norm(), 1e-12);
  const Vector3d v_B = 0.1 * (state.rotation().conjugate() * state.velocity());
  EXPECT_MATRIX_NEAR(known.body_velocity, v_B * v_B.transpose(), 1e-12);
}

TEST(DerivedCovariance, AnUnknownHeadingDoesNotBlurTheBodyVelocity) {
  const FrameState state = SomeState({0, 0, 0});
  Vector6d error;  // of a world rotation
  error << state.rotation().conjugate() * Vector3d::UnitZ(),
      Vector3d::UnitZ().cross(state.velocity());
  EXPECT_TRUE(BodyVelocityCovariance(state, error * error.transpose()).isZero(1e-12));
}

}  // namespace
}  // namespace plm_vins
