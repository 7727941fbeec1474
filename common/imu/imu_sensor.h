// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/imu/imu_range.h"

namespace plm_vins {

// Range and calibration of an IMU.
struct ImuSensor {
  ImuRange range;  // range of the readings as the sensor delivers them
  // A correction times a reading is the reading in the body frame with unit scale and orthogonal
  // axes [1]. The biases are those of corrected readings.
  Eigen::Matrix3d gyro_correction = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d accel_correction = Eigen::Matrix3d::Identity();
};

// Returns the sample with corrected readings. The identity leaves every bit as it is.
ImuSample Corrected(const ImuSample& sample, const ImuSensor& sensor);

// Returns the sample as the sensor delivers it; the inverse of Corrected().
ImuSample Uncorrected(const ImuSample& sample, const ImuSensor& sensor);

}  // namespace plm_vins
