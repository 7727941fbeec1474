// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/uncertain_state.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

const Vector3d kGravity_W(0, 0, -9.81);

FrameState Start() {
  FrameState state;
  state.SetPose({Eigen::Quaterniond(0.5, 0.1, -0.7, 0.3).normalized(), {1, 2, 3}});
  state.velocity() = Vector3d(0.5, -1, 0.2);
  state.SetBias({{0.1, 0.05, -0.1}, {0.01, 0, -0.02}});
  return state;
}

Preintegration Motion() {
  Preintegration motion(ImuNoise(), Start().bias());
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.005 * i;
    motion.Append({ToNanoseconds(t), {0.3, std::sin(t), -0.5}, {1, 9.81 * std::cos(t), 3 * t}});
  }
  return motion;
}

FrameState Plus(const FrameState& state, const Eigen::VectorXd& delta) {
  FrameState result = state;
  PosePlus(state.pose.data(), delta.data(), result.pose.data());
  for (int i = 0; i < 9; ++i) result.motion[i] += delta[6 + i];
  return result;
}

Eigen::VectorXd Minus(const FrameState& a, const FrameState& b) {
  Eigen::VectorXd delta(15);
  PoseMinus(a.pose.data(), b.pose.data(), delta.data());
  for (int i = 0; i < 9; ++i) delta[6 + i] = a.motion[i] - b.motion[i];
  return delta;
}

TEST(UncertainState, CovarianceIsPropagated) {
  const Preintegration motion = Motion();
  const FrameState end = motion.Predict(Start(), kGravity_W);
  const Eigen::MatrixXd d_end_d_start = testing::NumericJacobian(
      [&](const FrameState& start) { return Minus(motion.Predict(start, kGravity_W), end); },
      Start(), 15, Plus);
  const Matrix15d root = Matrix15d::Random();
  const Matrix15d covariance = root * root.transpose();
  const UncertainState certain = Propagate({Start(), Matrix15d::Zero()}, motion, kGravity_W);
  const UncertainState uncertain = Propagate({Start(), covariance}, motion, kGravity_W);
  EXPECT_MATRIX_NEAR(uncertain.state.position(), end.position(), 0.0);
  EXPECT_EQ(uncertain.state.t_ns, end.t_ns);
  EXPECT_MATRIX_NEAR(uncertain.covariance - certain.covariance,
                     d_end_d_start * covariance * d_end_d_start.transpose(), 1e-6);
}

TEST(UncertainState, NoiseIsRotatedToTheWorld) {
  const Preintegration motion = Motion();
  const UncertainState end = Propagate({Start(), Matrix15d::Zero()}, motion, kGravity_W);
  const Eigen::Matrix3d R_W_B0 = Start().rotation().toRotationMatrix();
  const Matrix15d noise = motion.Covariance();
  EXPECT_MATRIX_NEAR((end.covariance.topLeftCorner<3, 3>()),
                     R_W_B0 * (noise.topLeftCorner<3, 3>()) * R_W_B0.transpose(), 1e-12);
  EXPECT_GT(end.covariance(0, 0), 0);
}

TEST(UncertainState, DeviationsAreInTheWorldFrame) {
  UncertainState lying;  // the body's x axis points up
  lying.state.SetPose(
      {Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), Vector3d::UnitZ()), Vector3d::Zero()});
  lying.covariance.setZero();
  lying.covariance.diagonal() << 1, 4, 9, 0.01, 0.04, 0.09, Eigen::Matrix<double, 9, 1>::Zero();
  EXPECT_DOUBLE_EQ(PositionDeviation(lying), 3);
  EXPECT_NEAR(HeadingDeviation(lying), 0.1, 1e-12);
}

}  // namespace
}  // namespace plm_vins
