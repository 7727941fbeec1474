// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Returns the covariance of a frame's state, pose before motion, from the window's equations at
// their last linearization; nullopt if it is unobservable.
inline std::optional<Matrix15d> StateCovariance(int64_t t_ns, NormalEquations* equations) {
  const auto covariance =
      equations->Covariance({{BlockKind::kPose, t_ns}, {BlockKind::kMotion, t_ns}});
  if (!covariance) return std::nullopt;
  return *covariance;
}

// Returns the part of the pose.
inline std::optional<Eigen::Matrix<double, 6, 6>> PoseOf(
    const std::optional<Matrix15d>& covariance) {
  if (!covariance) return std::nullopt;
  return covariance->topLeftCorner<6, 6>();
}

// Returns the covariance of the newest state if only the states after a keyframe were solved for
// (PlacementProblem), from the covariance of the keyframe's state and `equations` at their last
// linearization. An error of the keyframe moves the landmarks rigidly with it and is propagated by
// the IMU; it is considered, but not estimated ([Schmidt1966]). Returns nullopt if the states
// are unobservable.
std::optional<Matrix15d> PlacedCovariance(const SlidingWindow& window, int64_t keyframe_ns,
                                          const Matrix15d& keyframe_covariance,
                                          NormalEquations* equations);

}  // namespace plm_vins
