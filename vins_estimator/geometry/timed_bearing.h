// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// One corner in one image, moved along its velocity v to the time that the frame's state stands
// for: the state was cut at t_image + cut_time_offset, the image was taken at t_image + td, so at
// the state's time the corner is at xy - (td - cut_time_offset) v.
struct TimedBearing {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalised, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [1/s]
  double cut_time_offset = 0;                          // [s]

  Eigen::Vector2d At(double td) const { return xy - (td - cut_time_offset) * velocity; }
};

}  // namespace plm_vins
