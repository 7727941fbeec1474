// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Evidence of one interval between keyframes of the optimized window on one source of IMU noise.
struct DensityEvidence {
  double assumed = 0;   // density of its white noise, in the units of ImuNoise
  double squared = 0;   // squared residual attributed to this source
  double expected = 0;  // mean of `squared` if the noise is as assumed
  double slope = 0;     // increase of `expected` per multiple of the assumed variance
};

struct ImuNoiseEvidence {
  DensityEvidence accel, gyro;
};

}  // namespace plm_vins
