// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/imu/preintegration.h"

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

}  // namespace plm_vins
