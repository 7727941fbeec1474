// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/frame_state.h"
#include "vins_estimator/uncertainty/imu_noise_estimate.h"

namespace plm_vins {

// Computes the evidence of the IMU residual between two states on the noise of accelerometer and
// gyroscope: variance components by restricted maximum likelihood, [Patterson1971]. `equations` are
// those of the solution. Let r be the residual, S its assumed covariance, S_k the part of S due to
// source k, and C the covariance of the residual in the solution. With P = S^-1 - S^-1 C S^-1, the
// statistic r^T S^-1 S_k S^-1 r has the mean tr(P S_k); it increases by (s - 1) tr(P S_k P S_k) if
// the source's variance in this interval is s times the assumed one. Returns nullopt if the two
// states are unobservable.
std::optional<ImuNoiseEvidence> EvidenceOfMotion(const Preintegration& motion,
                                                 const Eigen::Vector3d& gravity_W,
                                                 const FrameState& begin, const FrameState& end,
                                                 NormalEquations* equations);

}  // namespace plm_vins
