// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/gyro_predictor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

constexpr int64_t kFirstStamp = 1'403'636'579'000'000'000;  // the magnitude of real timestamps
constexpr int64_t kPeriod = 5'000'000;                      // 200 Hz
const Rigid3d T_B_C(SO3Exp({0.4, -1.3, 0.8}), {0.1, 0.2, 0.3});

ImuSample Sample(int64_t t_ns, const Eigen::Vector3d& gyro) {
  return {t_ns, gyro, Eigen::Vector3d(0, 0, 9.81)};
}

// Adds samples of `rate` (by seconds since start) for `seconds`.
template <typename Rate>
void Feed(GyroPredictor* predictor, double seconds, const Rate& rate) {
  for (int64_t t = 0; t <= ToNanoseconds(seconds); t += kPeriod) {
    predictor->AddImu(Sample(kFirstStamp + t, rate(ToSeconds(t))));
  }
}

TEST(GyroPredictor, ConstantRateBetweenArbitraryTimes) {
  const Eigen::Vector3d rate(0.5, -1.0, 2.0);
  GyroPredictor predictor(T_B_C, 0);
  Feed(&predictor, 0.5, [&](double) -> const Eigen::Vector3d& { return rate; });
  const int64_t t0 = kFirstStamp + 12'345'678, t1 = t0 + 50'000'000;
  // Direction fixed in the world: d_C1 = R_C_B Exp(-rate dt) R_B_C d_C0.
  const Eigen::Quaterniond R_B_C = T_B_C.rotation;
  const Eigen::Quaterniond expected = R_B_C.conjugate() * SO3Exp(-0.05 * rate) * R_B_C;
  const auto rotation = predictor.Rotation(t0, t1);
  ASSERT_TRUE(rotation);
  EXPECT_LT(rotation->angularDistance(expected), 1e-9);
}

TEST(GyroPredictor, UsesCorrectedReadings) {
  ImuSensor imu;
  imu.gyro_correction << 0, -1.02, 0, 0.98, 0, 0, 0.01, 0, 1;
  const Eigen::Vector3d rate(0.5, -1.0, 2.0);
  const Eigen::Vector3d reading = imu.gyro_correction.inverse() * rate;
  GyroPredictor predictor(Rigid3d(), 0, imu);
  Feed(&predictor, 0.5, [&](double) -> const Eigen::Vector3d& { return reading; });
  const auto rotation = predictor.Rotation(kFirstStamp, kFirstStamp + 50'000'000);
  ASSERT_TRUE(rotation);
  EXPECT_LT(rotation->angularDistance(SO3Exp(-0.05 * rate)), 1e-9);
}

TEST(GyroPredictor, ChangingRateAboutOneAxisIntegratesExactly) {
  GyroPredictor predictor(Rigid3d(), 0);
  Feed(&predictor, 0.5, [](double t) { return Eigen::Vector3d(0, 0, 3 * t); });
  const auto rotation = predictor.Rotation(kFirstStamp + 101'000'000, kFirstStamp + 203'000'000);
  ASSERT_TRUE(rotation);
  const double angle = 1.5 * (0.203 * 0.203 - 0.101 * 0.101);
  EXPECT_MATRIX_NEAR(SO3Log(*rotation), Eigen::Vector3d(0, 0, -angle), 1e-9);
}

TEST(GyroPredictor, TimeOffsetShiftsTheSamples) {
  constexpr double kOffset = 0.05;
  GyroPredictor predictor(Rigid3d(), kOffset);
  Feed(&predictor, 0.5, [](double t) { return Eigen::Vector3d(0, 0, 3 * t); });
  const auto rotation = predictor.Rotation(kFirstStamp + 100'000'000, kFirstStamp + 200'000'000);
  ASSERT_TRUE(rotation);
  EXPECT_NEAR(SO3Log(*rotation).z(), -1.5 * (0.25 * 0.25 - 0.15 * 0.15), 1e-9);
}

TEST(GyroPredictor, CoversUpToTheLastSample) {
  GyroPredictor predictor(Rigid3d(), 0.1);
  EXPECT_FALSE(predictor.Covers(kFirstStamp));
  predictor.AddImu(Sample(kFirstStamp + 100'000'000, Eigen::Vector3d::Zero()));
  EXPECT_TRUE(predictor.Covers(kFirstStamp));
  EXPECT_FALSE(predictor.Covers(kFirstStamp + 1));
}

TEST(GyroPredictor, RejectsIntervalsItDoesNotCover) {
  GyroPredictor predictor(Rigid3d(), 0);
  EXPECT_FALSE(predictor.Rotation(kFirstStamp, kFirstStamp));
  Feed(&predictor, 0.2, [](double) { return Eigen::Vector3d::Zero(); });
  EXPECT_FALSE(predictor.Rotation(kFirstStamp - 1, kFirstStamp + 1));
  EXPECT_FALSE(predictor.Rotation(kFirstStamp, kFirstStamp + 200'000'001));
  EXPECT_FALSE(predictor.Rotation(kFirstStamp + 2, kFirstStamp + 1));
  EXPECT_TRUE(predictor.Rotation(kFirstStamp, kFirstStamp + 200'000'000));
  EXPECT_TRUE(predictor.Rotation(kFirstStamp + 100, kFirstStamp + 100));
}

TEST(GyroPredictor, RejectsAGapInside) {
  GyroPredictor predictor(Rigid3d(), 0);
  Feed(&predictor, 0.1, [](double) { return Eigen::Vector3d::Zero(); });
  predictor.AddImu(Sample(kFirstStamp + 300'000'000, Eigen::Vector3d::Zero()));
  predictor.AddImu(Sample(kFirstStamp + 305'000'000, Eigen::Vector3d::Zero()));
  predictor.AddImu(Sample(kFirstStamp + 310'000'000, Eigen::Vector3d::Zero()));
  EXPECT_TRUE(predictor.Rotation(kFirstStamp, kFirstStamp + 90'000'000));
  EXPECT_FALSE(predictor.Rotation(kFirstStamp, kFirstStamp + 200'000'000));
  EXPECT_FALSE(predictor.Rotation(kFirstStamp + 90'000'000, kFirstStamp + 305'000'000));
  EXPECT_TRUE(predictor.Rotation(kFirstStamp + 305'000'000, kFirstStamp + 310'000'000));
}

TEST(GyroPredictor, DropsOldSamples) {
  GyroPredictor predictor(Rigid3d(), 0);
  Feed(&predictor, 20, [](double) { return Eigen::Vector3d::Zero(); });
  EXPECT_FALSE(predictor.Rotation(kFirstStamp, kFirstStamp + 50'000'000));
  EXPECT_TRUE(predictor.Rotation(kFirstStamp + 19'000'000'000, kFirstStamp + 20'000'000'000));
}

// The clock was wrong for a moment.
TEST(GyroPredictor, RestartsIfAllStampsJumpBack) {
  GyroPredictor predictor(Rigid3d(), 0);
  for (const int64_t t : {0, 1, 2}) {
    predictor.AddImu(
        Sample(kFirstStamp + 3'600'000'000'000 + t * kPeriod, Eigen::Vector3d::Zero()));
  }
  Feed(&predictor, 1, [](double) { return Eigen::Vector3d(0, 0, 1); });
  EXPECT_FALSE(predictor.Rotation(kFirstStamp + 100'000'000, kFirstStamp + 150'000'000))
      << "refused";
  EXPECT_TRUE(predictor.Rotation(kFirstStamp + 800'000'000, kFirstStamp + 850'000'000));
}

}  // namespace
}  // namespace plm_vins
