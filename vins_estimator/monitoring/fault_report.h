// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Facts that may explain why the camera persistently contradicts the IMU.
struct ContradictionEvidence {
  double noise_factor = 1;                  // assumed noise of the IMU over that of its samples
  double imu_jitter = 0, image_jitter = 0;  // timestamp jitter, root mean square [s]
  double imu_rate = 0, configured_imu_rate = 0;  // [Hz]
  // Noise of the samples themselves over acc_n and gyr_n (ImuNoiseMeter).
  double accel_noise_factor = 0, gyro_noise_factor = 0;
  // The rotations of camera and gyro (RotationCheck): they agree, or an error that was found
  // explains why they do not.
  enum class Rotations { kUnknown, kAgree, kExplained };
  Rotations rotations = Rotations::kUnknown;
};

// Describes a contradiction between camera and IMU: first the known faults, then what to check, the
// likeliest first, unless the rotations explain it.
std::string DescribeContradiction(const ContradictionEvidence& evidence);

// Describes what is wrong with cameras other than the first and with measured depths; empty if
// nothing is.
std::string DescribeFaults(const std::vector<CameraFaults>& cameras, const DepthFaults& depth);

}  // namespace plm_vins
