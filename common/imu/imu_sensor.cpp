// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_sensor.h"

#include <Eigen/LU>

namespace plm_vins {
namespace {

ImuSample Transformed(ImuSample sample, const Eigen::Matrix3d& gyro, const Eigen::Matrix3d& accel) {
  if (!gyro.isIdentity(0)) sample.gyro = (gyro * sample.gyro).eval();
  if (!accel.isIdentity(0)) sample.accel = (accel * sample.accel).eval();
  return sample;
}

}  // namespace

ImuSample Corrected(const ImuSample& sample, const ImuSensor& sensor) {
  return Transformed(sample, sensor.gyro_correction, sensor.accel_correction);
}

ImuSample Uncorrected(const ImuSample& sample, const ImuSensor& sensor) {
  return Transformed(sample, sensor.gyro_correction.inverse(), sensor.accel_correction.inverse());
}

}  // namespace plm_vins
