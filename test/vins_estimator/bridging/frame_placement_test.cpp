// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/frame_placement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

// An arbitrary state in flight with a small covariance.
UncertainState Known() {
  UncertainState known;
  known.state.SetPose({SO3Exp(Vector3d(0.2, -0.1, 2.5)), {3, -4, 5}});
  known.state.velocity() = Vector3d(1, 2, -0.5);
  known.covariance = 1e-6 * Matrix15d::Identity();
  return known;
}

// Transforms the state to the world of another window.
FrameState InAnotherWorld(FrameState state) {
  const Rigid3d T_new_W(SO3Exp(Vector3d(0, 0, -1.2)), {-7, 1, 2});
  state.SetPose(T_new_W * state.T_W_B());
  state.velocity() = T_new_W.rotation * state.velocity().eval();
  return state;
}

void ExpectSame(const FrameState& actual, const FrameState& expected) {
  EXPECT_MATRIX_NEAR(actual.position(), expected.position(), 1e-12);
  EXPECT_MATRIX_NEAR(actual.velocity(), expected.velocity(), 1e-12);
  EXPECT_LT(actual.rotation().angularDistance(expected.rotation()), 1e-7);
}

TEST(FramePlacement, TransformsAllStatesToTheKnownWorld) {
  const FrameState first = Known().state;
  FrameState second = first;
  second.position() += Vector3d(0.3, 0, 0.1);
  second.velocity() = Vector3d(0, 1, 0);
  const FramePlacement placement(first, InAnotherWorld(first));
  ExpectSame(placement.Apply(InAnotherWorld(first)), first);
  ExpectSame(placement.Apply(InAnotherWorld(second)), second);
}

TEST(FramePlacement, KeepsTheInclination) {
  FrameState tilted = Known().state;
  tilted.SetPose(
      {SO3Exp(Vector3d(0.1, 0, 0)) * Eigen::Quaterniond(tilted.rotation()), tilted.position()});
  const FrameState placed = FramePlacement(Known().state, tilted).Apply(tilted);
  const auto up = [](const FrameState& state) {
    return Vector3d(state.rotation().conjugate() * Vector3d::UnitZ());
  };
  EXPECT_MATRIX_NEAR(up(placed), up(tilted), 1e-12);
  EXPECT_NEAR(Yaw(Eigen::Quaterniond(placed.rotation() * Known().state.rotation().conjugate())), 0,
              1e-2);
}

TEST(DifferByFrame, PositionAndHeadingAreFree) {
  EXPECT_TRUE(DifferByFrame(Known(), Known().state));
  EXPECT_TRUE(DifferByFrame(Known(), InAnotherWorld(Known().state)));
}

TEST(DifferByFrame, VelocityAndInclinationAreNot) {
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    FrameState fresh = Known().state;
    fresh.velocity() += 0.3 * direction;
    EXPECT_TRUE(DifferByFrame(Known(), InAnotherWorld(fresh)));
    fresh.velocity() += 0.3 * direction;
    EXPECT_FALSE(DifferByFrame(Known(), InAnotherWorld(fresh)));
  }
  FrameState tilted = Known().state;
  tilted.rotation() = SO3Exp(Vector3d(0, 0.12, 0)) * tilted.rotation();
  EXPECT_FALSE(DifferByFrame(Known(), tilted));
}

TEST(DifferByFrame, UncertainStatesMayDiffer) {
  UncertainState known = Known();
  known.covariance(6, 6) = 1;
  FrameState fresh = known.state;
  fresh.velocity().x() += 2;
  EXPECT_TRUE(DifferByFrame(known, fresh));
  fresh.velocity().y() += 2;
  EXPECT_FALSE(DifferByFrame(known, fresh));
}

// Odometry whose heading has become uncertain still knows its velocity in the body frame.
TEST(DifferByFrame, AnUnknownHeadingDoesNotHideAWrongVelocity) {
  UncertainState known = Known();
  const FrameState& state = known.state;
  const Vector3d up_B = state.rotation().conjugate() * Vector3d::UnitZ();
  Eigen::Matrix<double, 15, 1> heading = Eigen::Matrix<double, 15, 1>::Zero();
  heading << Vector3d::Zero(), up_B, Vector3d::UnitZ().cross(state.velocity()),
      Eigen::Matrix<double, 6, 1>::Zero();
  known.covariance += heading * heading.transpose();  // one radian
  FrameState fresh = state;
  fresh.velocity() += 0.6 * Vector3d::UnitZ().cross(state.velocity()).normalized();
  EXPECT_FALSE(DifferByFrame(known, fresh));
}

}  // namespace
}  // namespace plm_vins
