// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/failure/failure_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/geometry/so3.h"
#include "common/measurements.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;

using Eigen::Vector3d;

class FailureDetectorTest : public ::testing::Test {
 protected:
  // Returns the failure, or an empty string.
  std::string Detect() const { return DetectFailure(predicted_, optimized_).value_or(""); }

  FrameState predicted_, optimized_;
};

TEST_F(FailureDetectorTest, AcceptsValuesWithinTheLimits) {
  EXPECT_EQ(Detect(), "");
  optimized_.accel_bias() = Vector3d(2.9, 0, 0);
  optimized_.gyro_bias() = Vector3d(0, 0.49, 0);
  optimized_.velocity() = Vector3d(0, 0, 2.9);
  optimized_.position() = Vector3d(1.9, 0, 0);
  optimized_.rotation() = SO3Exp({0.69, 0, 0});
  EXPECT_EQ(Detect(), "");
}

TEST_F(FailureDetectorTest, NamesTheBias) {
  optimized_.accel_bias() = Vector3d(0, 0, 3.5);
  EXPECT_THAT(Detect(), HasSubstr("accelerometer bias is 3.50"));
  optimized_.accel_bias().setZero();
  optimized_.gyro_bias() = Vector3d(0, -0.75, 0);
  EXPECT_THAT(Detect(), HasSubstr("gyro bias is 0.75"));
}

TEST_F(FailureDetectorTest, NamesAnAbsurdVelocity) {
  predicted_.velocity() = optimized_.velocity() = Vector3d(60, 0, 0);
  EXPECT_THAT(Detect(), HasSubstr("velocity is 60.00"));
}

TEST_F(FailureDetectorTest, NamesTheCorrectionThatIsTooLarge) {
  predicted_.velocity() = Vector3d(1, 0, 0);
  optimized_.velocity() = Vector3d(5, 0, 0);
  EXPECT_THAT(Detect(), HasSubstr("velocity is 4.00"));
  predicted_.velocity() = optimized_.velocity();
  predicted_.position() = Vector3d(10, 0, 0);
  optimized_.position() = Vector3d(10, 0, -2.5);
  EXPECT_THAT(Detect(), HasSubstr("position is 2.50"));
  predicted_.position() = optimized_.position();
  optimized_.rotation() = SO3Exp({0, 1.25, 0});
  EXPECT_THAT(Detect(), HasSubstr("rotation is 1.25"));
}

TEST_F(FailureDetectorTest, QuaternionsOfOppositeSignAreTheSameRotation) {
  predicted_.rotation() = SO3Exp({0, 0.3, 0});
  optimized_.rotation().coeffs() = -predicted_.rotation().coeffs();
  EXPECT_EQ(Detect(), "");
}

TEST_F(FailureDetectorTest, NamesValuesThatAreNotFinite) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    optimized_ = FrameState();
    optimized_.pose[4] = value;
    EXPECT_THAT(Detect(), HasSubstr("non-finite"));
    optimized_ = FrameState();
    optimized_.motion[8] = value;
    EXPECT_THAT(Detect(), HasSubstr("non-finite"));
  }
}

// Adds images at 20 Hz from 0 s on with constant counts; returns the time [s] of the first alarm,
// or -1.
double FirstAlarm(ContradictionMonitor* monitor, int landmarks, int rejected, int images) {
  for (int i = 0; i < images; ++i) {
    if (monitor->Add(ToNanoseconds(0.05 * i), landmarks, rejected)) return 0.05 * i;
  }
  return -1;
}

TEST(ContradictionMonitor, AlarmsAfterHalfASecondOfContradiction) {
  ContradictionMonitor monitor;
  EXPECT_DOUBLE_EQ(FirstAlarm(&monitor, 100, 25, 40), 0.5);
  monitor = ContradictionMonitor();
  EXPECT_EQ(FirstAlarm(&monitor, 100, 25, 10), -1);
}

TEST(ContradictionMonitor, ReportsTheRejectedShare) {
  ContradictionMonitor monitor;
  EXPECT_EQ(FirstAlarm(&monitor, 100, 60, 10), -1);
  EXPECT_EQ(monitor.Add(ToNanoseconds(0.62), 80, 40).value_or(""),
            "the camera contradicts the state: 40 of 80 landmarks rejected, for 0.6 s");
}

TEST(ContradictionMonitor, APauseOfImagesIsNoContradiction) {
  ContradictionMonitor monitor;
  EXPECT_FALSE(monitor.Add(0, 100, 60));
  EXPECT_FALSE(monitor.Add(ToNanoseconds(0.6), 100, 60));
  EXPECT_TRUE(monitor.Add(ToNanoseconds(1.2), 100, 60)) << "three images say it";
}

TEST(ContradictionMonitor, ToleratesOutliersAndChance) {
  ContradictionMonitor monitor;
  EXPECT_EQ(FirstAlarm(&monitor, 100, 24, 100), -1);
  EXPECT_EQ(FirstAlarm(&monitor, 4, 4, 100), -1);
  EXPECT_DOUBLE_EQ(FirstAlarm(&monitor, 5, 5, 100), 0.5);
}

TEST(ContradictionMonitor, ContinuesWithFewLandmarks) {
  ContradictionMonitor monitor;
  EXPECT_EQ(FirstAlarm(&monitor, 40, 30, 10), -1);
  EXPECT_TRUE(monitor.Add(ToNanoseconds(0.5), 8, 3));
  monitor = ContradictionMonitor();
  EXPECT_EQ(FirstAlarm(&monitor, 40, 30, 10), -1);
  EXPECT_FALSE(monitor.Add(ToNanoseconds(0.5), 0, 0)) << "nothing is left, nothing is rejected";
}

TEST(ContradictionMonitor, ImagesWithFewLandmarksDoNotChangeIt) {
  for (const int shown : {0, 5}) {
    ContradictionMonitor monitor;
    EXPECT_EQ(FirstAlarm(&monitor, 40, 30, 10), -1);
    for (int i = 10; i < 40; ++i) EXPECT_FALSE(monitor.Add(ToNanoseconds(0.05 * i), shown, 0));
    EXPECT_TRUE(monitor.contradicts());
    EXPECT_EQ(monitor.Add(ToNanoseconds(2), 6, 5).value_or(""),
              "the camera contradicts the state: 5 of 6 landmarks rejected, for 0.5 s");
  }
  ContradictionMonitor monitor;
  EXPECT_EQ(FirstAlarm(&monitor, 40, 30, 10), -1);
  EXPECT_FALSE(monitor.Add(ToNanoseconds(0.5), 6, 0));
  EXPECT_FALSE(monitor.contradicts());
  EXPECT_FALSE(monitor.Add(ToNanoseconds(0.55), 6, 5));
}

TEST(ContradictionMonitor, ConsistentImageResetsIt) {
  ContradictionMonitor monitor;
  for (int i = 0; i < 200; ++i) {
    const int rejected = i % 10 == 0 ? 0 : 50;
    EXPECT_FALSE(monitor.Add(ToNanoseconds(0.05 * i), 100, rejected)) << i;
  }
}

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
