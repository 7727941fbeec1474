// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/measurements.h"

namespace plm_vins {

// Largest absolute reading of any axis of an IMU.
struct ImuRange {
  double gyro = 35.0;    // [rad/s], 2000 deg/s
  double accel = 160.0;  // [m/s^2], 16 g
};

// Exceeds the readings of IMUs on vehicles and handheld devices.
constexpr ImuRange kAnyImuRange = {100.0, 500.0};

// More than a gyroscope at standstill measures, with any usual bias [rad/s].
constexpr double kMostStandingRate = 0.1;

// Returns whether all readings are finite and within the range.
inline bool IsInRange(const ImuSample& sample, const ImuRange& range = kAnyImuRange) {
  return sample.gyro.allFinite() && sample.accel.allFinite() &&
         sample.gyro.cwiseAbs().maxCoeff() <= range.gyro &&
         sample.accel.cwiseAbs().maxCoeff() <= range.accel;
}

// Returns whether a sample may come from an inertial sensor. All-zero readings, which drivers send
// after read errors, and invalid timestamps are not plausible.
inline bool IsPlausible(const ImuSample& sample) {
  return IsStamp(sample.t_ns) && IsInRange(sample) &&
         !(sample.gyro.isZero(0.0) && sample.accel.isZero(0.0));
}

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
