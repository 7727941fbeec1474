// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_noise.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(ImuNoise, DensitiesGiveTheVarianceOfTheSamples) {
  constexpr double kRate = 250, kDt = 1 / kRate;
  constexpr int kSteps = 500;
  const ImuNoise sample = {0.004, 0.08, 2e-6, 4e-5};
  const ImuNoise density = DensitiesFromSamples(sample, kRate);
  // Both sides are the variance after kSteps steps, that is kSteps * kDt seconds.
  const double seconds = kSteps * kDt;
  const auto summed = [&](double n) { return kSteps * n * n * kDt * kDt; };
  const auto integrated = [&](double d) { return d * d * seconds; };
  EXPECT_NEAR(integrated(density.gyro_density) / summed(sample.gyro_density), 1, 1e-12);
  EXPECT_NEAR(integrated(density.accel_density) / summed(sample.accel_density), 1, 1e-12);
  EXPECT_NEAR(integrated(density.gyro_walk) / summed(sample.gyro_walk), 1, 1e-12);
  EXPECT_NEAR(integrated(density.accel_walk) / summed(sample.accel_walk), 1, 1e-12);
}

TEST(ImuNoise, VinsEurocNumbersBecomeThoseOfAConsumerImu) {
  const ImuNoise density = DensitiesFromSamples({0.004, 0.08, 2e-6, 4e-5}, 200);
  EXPECT_NEAR(density.gyro_density, 2.828e-4, 1e-7);
  EXPECT_NEAR(density.accel_density, 5.657e-3, 1e-6);
}

}  // namespace
}  // namespace plm_vins
