// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/default_sensors.h"
#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

TrajectoryOptions Options(Motion motion) {
  TrajectoryOptions options;
  options.motion = motion;
  options.duration = 30.0;
  options.R_V_B = ForwardLookingBody(DefaultSensors().cameras[0].T_B_C);
  return options;
}

double MeanSpeed(const Trajectory& trajectory) {
  double sum = 0;
  for (int i = 0; i < 1000; ++i) sum += trajectory.At(2.0 + 0.028 * i).v_W.norm();
  return sum / 1000;
}

TEST(Random, IsTheSameEverywhere) {
  Random random(1);
  EXPECT_DOUBLE_EQ(random.Uniform(), Random(1).Uniform());
  EXPECT_NE(Random(1).Uniform(), Random(2).Uniform());
  EXPECT_NE(Random(1, 0).Uniform(), Random(1, 1).Uniform());
}

TEST(Random, HasTheMomentsOfItsDistributions) {
  Random random(3);
  constexpr int kCount = 100000;
  double uniform = 0, normal = 0, normal_squared = 0;
  for (int i = 0; i < kCount; ++i) {
    uniform += random.Uniform();
    const double x = random.Normal();
    normal += x;
    normal_squared += x * x;
  }
  EXPECT_NEAR(uniform / kCount, 0.5, 0.005);
  EXPECT_NEAR(normal / kCount, 0.0, 0.015);
  EXPECT_NEAR(normal_squared / kCount, 1.0, 0.02);
}

class TrajectoryOfEachMotion : public testing::TestWithParam<Motion> {};

TEST_P(TrajectoryOfEachMotion, DerivativesAgreeWithDifferences) {
  const Trajectory trajectory(Options(GetParam()));
  const double h = 1e-4;
  for (double t = 0.5; t < 29.0; t += 0.37) {
    const BodyState before = trajectory.At(t - h), now = trajectory.At(t),
                    after = trajectory.At(t + h);
    const Vector3d velocity = (after.T_W_B.translation - before.T_W_B.translation) / (2 * h);
    const Vector3d acceleration = (after.v_W - before.v_W) / (2 * h);
    const Vector3d rate =
        SO3Log(before.T_W_B.rotation.conjugate() * after.T_W_B.rotation) / (2 * h);
    EXPECT_LT((now.v_W - velocity).norm(), 1e-6) << "at " << t;
    EXPECT_LT((now.a_W - acceleration).norm(), 1e-5) << "at " << t;
    EXPECT_LT((now.gyro_B - rate).norm(), 1e-6) << "at " << t;
  }
}

TEST_P(TrajectoryOfEachMotion, StartsAtStandstillAndStaysInItsBox) {
  const TrajectoryOptions options = Options(GetParam());
  const Trajectory trajectory(options);
  for (double t = 0; t <= options.rest; t += 0.05) {
    EXPECT_LT(trajectory.At(t).v_W.norm(), 1e-12);
    EXPECT_LT(trajectory.At(t).gyro_B.norm(), 1e-12);
  }
  for (double t = 0; t <= options.duration; t += 0.1) {
    const Vector3d offset = trajectory.At(t).T_W_B.translation - options.center;
    EXPECT_TRUE((offset.cwiseAbs().array() <= options.extent.array() + 1e-9).all()) << "at " << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, TrajectoryOfEachMotion,
                         testing::Values(Motion::kGentle, Motion::kFast, Motion::kHover,
                                         Motion::kPureRotation, Motion::kCorridor, Motion::kStill));

TEST(Trajectory, GentleIsSlowAndFastIsFast) {
  const double gentle = MeanSpeed(Trajectory(Options(Motion::kGentle)));
  const double fast = MeanSpeed(Trajectory(Options(Motion::kFast)));
  EXPECT_GT(gentle, 0.3);
  EXPECT_LT(gentle, 0.9);
  EXPECT_GT(fast, 1.0);
  EXPECT_LT(fast, 3.0);
}

TEST(Trajectory, FlightsExciteAllAxes) {
  for (Motion motion : {Motion::kGentle, Motion::kFast}) {
    const Trajectory trajectory(Options(motion));
    Vector3d acceleration = Vector3d::Zero(), rate = Vector3d::Zero();
    for (double t = 1; t < 10; t += 0.05) {
      acceleration = acceleration.cwiseMax(trajectory.At(t).a_W.cwiseAbs());
      rate = rate.cwiseMax(trajectory.At(t).gyro_B.cwiseAbs());
    }
    EXPECT_GT(acceleration.minCoeff(), 0.2);
    EXPECT_GT(rate.minCoeff(), 0.1);
  }
}

TEST(Trajectory, HoverAndPureRotationHoldTheirPositionAfterTheLeadIn) {
  for (Motion motion : {Motion::kHover, Motion::kPureRotation}) {
    const Trajectory trajectory(Options(motion));
    const Vector3d place = trajectory.At(29).T_W_B.translation;
    double rate = 0;
    for (double t = 15; t < 29; t += 0.1) {
      EXPECT_LT((trajectory.At(t).T_W_B.translation - place).norm(), 0.12);
      rate = std::max(rate, trajectory.At(t).gyro_B.norm());
    }
    EXPECT_GT((trajectory.At(0).T_W_B.translation - place).norm(), 0.15) << "has flown before";
    if (motion == Motion::kPureRotation) {
      EXPECT_GT(rate, 0.3);
      EXPECT_LT(trajectory.At(20).v_W.norm(), 1e-12);
    }
  }
}

TEST(Trajectory, CorridorRunsStraightFromEndToEnd) {
  const Trajectory trajectory(Options(Motion::kCorridor));
  EXPECT_NEAR(trajectory.At(0).T_W_B.translation.x(), -2.0, 1e-9);
  EXPECT_NEAR(trajectory.At(30).T_W_B.translation.x(), 2.0, 0.3);
}

TEST(Trajectory, CameraLooksForwardAndUpright) {
  const SensorConfig sensors = DefaultSensors();
  TrajectoryOptions options = Options(Motion::kStill);
  const Rigid3d T_W_C = Trajectory(options).At(0).T_W_B * sensors.cameras[0].T_B_C;
  EXPECT_TRUE((T_W_C.rotation * Vector3d::UnitZ()).isApprox(Vector3d::UnitX(), 1e-9));
  EXPECT_TRUE((T_W_C.rotation * Vector3d::UnitY()).isApprox(-Vector3d::UnitZ(), 1e-9));
}

}  // namespace
}  // namespace plm_vins::simulator
