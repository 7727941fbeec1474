// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

namespace plm_vins {

// Ends a flight on the IMU alone once the position has become too uncertain for what is said of it.
// A second without features is bridged this way; after ten the IMU has drifted by metres.
class BlindnessMonitor {
 public:
  // Takes how many features the newest image shows and the covariance of its position [m^2]. The
  // reason once the state cannot be kept; nothing before.
  std::optional<std::string> Add(int64_t t_ns, int features_seen,
                                 const Eigen::Matrix3d& position_covariance);

 private:
  std::optional<int64_t> since_ns_;  // the first image without features
  double variance_before_ = 0;       // of the position when some were seen last [m^2]
};

}  // namespace plm_vins
