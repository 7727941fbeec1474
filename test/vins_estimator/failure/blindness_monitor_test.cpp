// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/blindness_monitor.h"

#include <gtest/gtest.h>

#include "common/measurements.h"

namespace plm_vins {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

FrameState At(int64_t t_ns, const Eigen::Vector3d& p_W = Eigen::Vector3d::Zero()) {
  FrameState state;
  state.t_ns = t_ns;
  state.position() = p_W;
  return state;
}

// Covariance of a position with this standard deviation over all directions.
Matrix6d Known(double deviation) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(deviation * deviation / 3);
  return covariance;
}

TEST(BlindnessMonitor, ToleratesDriftWithFeatures) {
  BlindnessMonitor monitor;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(monitor.Add(6, true, At(i), Known(0.01 * i)));
}

TEST(BlindnessMonitor, FailsAfterTooMuchBlindDrift) {
  BlindnessMonitor monitor;
  monitor.Add(100, true, At(0), Known(3.0));
  EXPECT_FALSE(monitor.Add(0, false, At(ToNanoseconds(0.5)), Known(3.0)));
  EXPECT_FALSE(monitor.Add(5, false, At(ToNanoseconds(1.5)), Known(3.02)));
  EXPECT_EQ(
      monitor.Add(5, false, At(ToNanoseconds(3.5)), Known(3.06)).value_or(""),
      "no feature has constrained the position for 3.5 s; its standard deviation grew by 0.60 m");
}

TEST(BlindnessMonitor, FeaturesWithoutConstraintCountAsBlindness) {
  BlindnessMonitor monitor;
  monitor.Add(100, true, At(0), Known(0.1));
  for (int i = 1; i < 10; ++i) {
    EXPECT_FALSE(monitor.Add(100, false, At(ToNanoseconds(0.5 * i)), Known(0.05 * i)));
    EXPECT_FALSE(monitor.blind());
  }
  EXPECT_EQ(
      monitor.Add(100, false, At(ToNanoseconds(5.0)), Known(0.6)).value_or(""),
      "no feature has constrained the position for 5.0 s; its standard deviation grew by 0.59 m");
}

TEST(BlindnessMonitor, ImageGapCountsAsBlindness) {
  BlindnessMonitor monitor;
  monitor.Add(100, true, At(0), Known(0.1));
  EXPECT_EQ(
      monitor.Add(100, true, At(ToNanoseconds(4.0)), Known(0.6)).value_or(""),
      "no feature has constrained the position for 4.0 s; its standard deviation grew by 0.59 m");
}

TEST(BlindnessMonitor, IgnoresAnUnknownCovariance) {
  BlindnessMonitor monitor;
  EXPECT_FALSE(monitor.Add(100, true, At(0), std::nullopt));
  EXPECT_FALSE(monitor.Add(100, true, At(1), Known(3.0)));
  EXPECT_FALSE(monitor.Add(100, true, At(2), std::nullopt));
  EXPECT_FALSE(monitor.Add(5, false, At(3), Known(3.0)));
  EXPECT_TRUE(monitor.blind());
  EXPECT_FALSE(monitor.Add(100, true, At(4), std::nullopt));
  EXPECT_FALSE(monitor.blind());
  EXPECT_TRUE(monitor.Add(5, false, At(5), Known(3.1)));
}

// Far from the origin of the world, an uncertain heading moves the position by meters.
TEST(BlindnessMonitor, HeadingDriftOfTheWorldDoesNotCount) {
  constexpr double kHeading = 0.014;  // standard deviation [rad]
  BlindnessMonitor monitor;
  for (const double speed : {20.0, -20.0}) {
    for (int i = 0; i <= 20; ++i) {
      const FrameState state = At(i, {1000 + speed * 0.05 * i, 0, 0});
      Matrix6d covariance = Known(0.1);
      Eigen::Matrix<double, 6, 1> turn;
      turn << 0, state.position().x(), 0, 0, 0, 1;
      covariance += kHeading * kHeading * turn * turn.transpose();
      EXPECT_FALSE(monitor.Add(100, i == 0, state, covariance)) << speed << ' ' << i;
      if (i < 20) continue;
      covariance.diagonal().head<3>().array() += 0.1;  // drift, in either direction
      EXPECT_TRUE(monitor.Add(100, false, state, covariance)) << speed;
    }
  }
}

TEST(BlindnessMonitor, FeaturesResetIt) {
  BlindnessMonitor monitor;
  monitor.Add(0, false, At(0), Known(0.4));
  monitor.Add(50, true, At(1), Known(0.4));
  EXPECT_FALSE(monitor.Add(0, false, At(2), Known(0.6)));
}

}  // namespace
}  // namespace plm_vins
