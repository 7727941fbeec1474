// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Ends a flight on the IMU alone once the position has become too uncertain for what is said of it.
// A second without features is bridged this way; after ten the IMU has drifted by metres. The same
// holds for seconds without any image or IMU sample, and where nothing of what is seen fits.
class BlindnessMonitor {
 public:
  // Takes how many features the newest image shows, how many of them hold the position (known
  // landmarks where they should be), and its state, with the covariance of (p_W, rotation in B),
  // zero where that is not known, which says nothing. The reason once the state cannot be kept;
  // nothing before.
  std::optional<std::string> Add(int features_seen, int features_holding, const FrameState& state,
                                 const Eigen::Matrix<double, 6, 6>& pose_covariance);

  bool blind() const { return blind_; }  // the newest image shows next to nothing

 private:
  struct Hold {
    int64_t t_ns;
    Eigen::Vector3d p_W;
    double variance;  // of the position, summed over the axes [m^2]
  };

  std::optional<Hold> hold_;  // by the last image that held the position, or the first one of all
  bool blind_ = false;
};

}  // namespace plm_vins
