// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vins_estimator/imu/imu_noise_evidence.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/normal_equations.h"

namespace plm_vins {

// What the IMU's residual between two neighbouring frames says of the noise of accelerometer and
// gyro: variance components by restricted maximum likelihood, [Patterson1971]. `equations` are
// those of the solved window. Let r be the residual, S its covariance as assumed, S_k what of it is
// due to one source, C the covariance of the residual as the solution knows it. Then r^T S^-1 S_k
// S^-1 r has the mean tr(P S_k) with P = S^-1 - S^-1 C S^-1, and tr(P S_k P S_k) more for each time
// that the variance of this source is more than assumed in this interval alone. Nothing where the
// equations do not determine the two states.
std::optional<ImuNoiseEvidence> EvidenceOfMotion(const SlidingWindow& window,
                                                 const WindowFrame& begin, const WindowFrame& end,
                                                 NormalEquations* equations);

}  // namespace plm_vins
