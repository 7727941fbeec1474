// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

namespace plm_vins {

// Ends a flight on the IMU alone once the position has become too uncertain for what is said of it.
// A second without features is bridged this way; after ten the IMU has drifted by metres. The same
// holds for seconds without any image or IMU sample, and where nothing of what is seen fits.
class BlindnessMonitor {
 public:
  // Takes how many features the newest image shows, how many of them hold the position (known
  // landmarks where they should be), and the covariance of the position [m^2], zero where that is
  // not known, which says nothing. The reason once the state cannot be kept; nothing before.
  std::optional<std::string> Add(int64_t t_ns, int features_seen, int features_holding,
                                 const Eigen::Matrix3d& position_covariance);

  bool blind() const { return blind_; }  // the newest image shows next to nothing

 private:
  std::optional<int64_t> held_ns_;  // the last image that held it, or the first one of all
  double variance_before_ = 0;      // of the position then [m^2]
  bool blind_ = false;
};

}  // namespace plm_vins
