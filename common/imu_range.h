// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/measurements.h"

namespace plm_vins {

// False for what is not finite and what is beyond the inertial sensors of vehicles and hands.
inline bool IsInRange(const ImuSample& sample) {
  constexpr double kMaxGyro = 100.0;   // [rad/s]
  constexpr double kMaxAccel = 500.0;  // [m/s^2]
  return sample.gyro.allFinite() && sample.accel.allFinite() &&
         sample.gyro.cwiseAbs().maxCoeff() <= kMaxGyro &&
         sample.accel.cwiseAbs().maxCoeff() <= kMaxAccel;
}

}  // namespace plm_vins
