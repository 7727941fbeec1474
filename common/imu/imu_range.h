// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/measurements.h"

namespace plm_vins {

// Largest absolute reading of any axis of an IMU.
struct ImuRange {
  double gyro = 35.0;    // [rad/s], 2000 deg/s
  double accel = 160.0;  // [m/s^2], 16 g
};

// Exceeds the readings of IMUs on vehicles and handheld devices.
constexpr ImuRange kAnyImuRange = {100.0, 500.0};

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

}  // namespace plm_vins
