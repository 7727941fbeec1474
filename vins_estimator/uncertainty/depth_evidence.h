// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {

// Whether the depth of the scene can be known: from the start on, by measurements in single frames,
// or by motion since the start. Without these, noise places points arbitrarily near.
class DepthEvidence {
 public:
  void Begin(const Eigen::Vector3d& p_W, bool is_known) {
    start_W_ = p_W;
    is_known_ = is_known;
  }

  // Adds the number of used measurements of depth in single frames.
  void AddMeasured(int count) { is_known_ = is_known_ || count >= kLeastMeasured; }

  // Adds the newest position with the covariance of its state.
  void Add(const Eigen::Vector3d& p_W, const std::optional<Matrix15d>& covariance) {
    if (!covariance) return;
    const double deviation = std::sqrt(covariance->diagonal().head<3>().maxCoeff());
    const double least = std::max(kLeastMotion, kSignificant * deviation);
    is_known_ = is_known_ || (p_W - start_W_).norm() > least;
  }

  bool is_known() const { return is_known_; }

 private:
  static constexpr int kLeastMeasured = 10;
  static constexpr double kLeastMotion = 0.01;  // [m]
  static constexpr double kSignificant = 3;     // standard deviations

  Eigen::Vector3d start_W_ = Eigen::Vector3d::Zero();
  bool is_known_ = false;
};

}  // namespace plm_vins
