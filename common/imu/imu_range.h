// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/measurements.h"

namespace plm_vins {

// Largest reading of any axis of an IMU.
struct ImuRange {
  double gyro = 35.0;    // [rad/s], 2000 deg/s
  double accel = 160.0;  // [m/s^2], 16 g
};

// Beyond the inertial sensors of vehicles and hands.
constexpr ImuRange kAnyImuRange = {100.0, 500.0};

// False for what is not finite, too.
inline bool IsInRange(const ImuSample& sample, const ImuRange& range = kAnyImuRange) {
  return sample.gyro.allFinite() && sample.accel.allFinite() &&
         sample.gyro.cwiseAbs().maxCoeff() <= range.gyro &&
         sample.accel.cwiseAbs().maxCoeff() <= range.accel;
}

// What an inertial sensor may have read: false also for zeros throughout, which drivers give where
// they could not read it, and with a stamp that is none.
inline bool IsPlausible(const ImuSample& sample) {
  return IsStamp(sample.t_ns) && IsInRange(sample) &&
         !(sample.gyro.isZero(0.0) && sample.accel.isZero(0.0));
}

}  // namespace plm_vins
