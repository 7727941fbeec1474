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
  std::string Detect() const {
    return DetectFailure(FailureLimits(), predicted_, optimized_).value_or("");
  }

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

}  // namespace
}  // namespace plm_vins
