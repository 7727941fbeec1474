// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

const ImuSample kSample = {7, {1, 2, 3}, {-4, 5, 9}, 0.25, 0.5};

TEST(ImuSensor, CorrectsWithItsMatrices) {
  ImuSensor sensor;
  sensor.gyro_correction << 0, -2, 0, 1, 0, 0, 0, 0, 1;
  sensor.accel_correction << 0.5, 0, 0, 0, 1, 0, 0, 0.25, 2;
  const ImuSample corrected = Corrected(kSample, sensor);
  EXPECT_EQ(corrected.gyro, Eigen::Vector3d(-4, 1, 3));
  EXPECT_EQ(corrected.accel, Eigen::Vector3d(-2, 5, 19.25));
  EXPECT_EQ(corrected.t_ns, 7);
  EXPECT_EQ(corrected.gyro_doubt, 0.25);
  const ImuSample again = Uncorrected(corrected, sensor);
  EXPECT_LT((again.gyro - kSample.gyro).norm(), 1e-14);
  EXPECT_LT((again.accel - kSample.accel).norm(), 1e-14);
}

TEST(ImuSensor, IdentityIsBitExact) {
  ImuSample sample = kSample;
  sample.gyro.x() = -0.0;
  for (const ImuSample& same : {Corrected(sample, ImuSensor()), Uncorrected(sample, ImuSensor())}) {
    EXPECT_TRUE(std::signbit(same.gyro.x()));
    EXPECT_EQ(same.accel, sample.accel);
  }
}

}  // namespace
}  // namespace plm_vins
