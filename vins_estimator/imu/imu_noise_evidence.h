// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// What the solved window says of one source of the IMU's noise, from one interval between
// keyframes.
struct DensityEvidence {
  double assumed = 0;   // density of its white noise, in the units of ImuNoise
  double squared = 0;   // the squared residual, as far as this source accounts for it
  double expected = 0;  // the mean of `squared`, were the noise as assumed
  double slope = 0;     // how much more it would be for each time of the assumed variance more
};

struct ImuNoiseEvidence {
  DensityEvidence accel, gyro;
};

}  // namespace plm_vins
