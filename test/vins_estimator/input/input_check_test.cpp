// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/input_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class InputCheckTest : public ::testing::Test {
 protected:
  InputCheckTest() {
    sensor_.cameras[0].image_topic = "/cam";
    sensor_.imu_topic = "/imu";
  }

  // Five seconds of both; returns what is found. `stamp_of` stamps the sample that was taken at a
  // time.
  template <typename Stamp>
  std::string Finding(const Stamp& stamp_of, const Eigen::Vector3d& gyro, double image_error = 0) {
    InputCheck check(sensor_);
    ImuBursts bursts;
    for (int64_t i = 0; i < 1000; ++i) {
      const double noise = 1e-3 * static_cast<double>(i % 10);
      const ImuSample sample{stamp_of(i), gyro,
                             Eigen::Vector3d(0, 0, sensor_.gravity_norm).array() + noise};
      check.AddImu(sample);
      bursts.Spread(sample);
      if (i % 10 == 0) check.AddImage(kStart_ns + i * kStep_ns + ToNanoseconds(image_error));
    }
    return check.Finding(bursts);
  }

  static int64_t AsTaken(int64_t i) { return kStart_ns + i * kStep_ns; }
  static int64_t InBursts(int64_t i) { return AsTaken(i - i % 8 + 7); }

  static constexpr int64_t kStart_ns = 1'000'000'000'000, kStep_ns = 5'000'000;
  const Eigen::Vector3d kTurn = {0.1, 0, 0.2}, kNone = {0, 0, 0};
  SensorConfig sensor_;
};

TEST_F(InputCheckTest, NamesTheKeyAndTheTopicOfTheMostSeriousFinding) {
  EXPECT_THAT(Finding(AsTaken, kTurn), IsEmpty());
  EXPECT_THAT(Finding(InBursts, kTurn), HasSubstr("samples on imu_topic /imu come in bursts of 8"));
  EXPECT_THAT(Finding(InBursts, kNone), HasSubstr("is imu_topic /imu the accelerometer's"));
  EXPECT_THAT(Finding(AsTaken, kNone, 5), HasSubstr("images (image_topic /cam) and IMU (imu_topic "
                                                    "/imu) have different clocks"));
  EXPECT_THAT(Finding([](int64_t) { return 0; }, kNone, 5),
              HasSubstr("all stamps of imu_topic /imu are zero"));
}

TEST_F(InputCheckTest, ExpectsTheConfiguredTimeOffset) {
  sensor_.td = -5;
  EXPECT_THAT(Finding(AsTaken, kTurn, 5), IsEmpty());
  EXPECT_THAT(Finding(AsTaken, kTurn), HasSubstr("different clocks"));
}

}  // namespace
}  // namespace plm_vins
