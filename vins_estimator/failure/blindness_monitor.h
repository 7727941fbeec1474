// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Declares tracking lost once dead reckoning has made the position too uncertain. A second without
// features is bridged by the IMU; after ten seconds it has drifted by meters. The same holds for
// seconds without images or IMU samples, and if all observations are outliers.
class BlindnessMonitor {
 public:
  // Adds an image: the number of observed features, whether known landmarks or a standstill
  // constrain the position, and the state with the covariance of (p_W, rotation in B); without a
  // covariance the image is ignored. Returns the reason once tracking is lost, else nullopt.
  std::optional<std::string> Add(int features_seen, bool is_held, const FrameState& state,
                                 const std::optional<Eigen::Matrix<double, 6, 6>>& covariance);

  bool blind() const { return blind_; }  // the newest image has too few features

 private:
  struct Hold {
    int64_t t_ns;
    Eigen::Vector3d p_W;
    double variance;  // position variance, summed over the axes [m^2]
  };

  std::optional<Hold> hold_;  // at the last image that constrained the position, or the first image
  bool blind_ = false;
};

}  // namespace plm_vins
