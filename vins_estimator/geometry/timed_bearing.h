// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// Observation of a corner, extrapolated along its velocity v to the time of the frame's state: the
// state is at t_image + cut_time_offset and the image was taken at t_image + td, so at the state's
// time the corner is at xy - (td - cut_time_offset) v.
struct TimedBearing {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalized, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [1/s]
  double cut_time_offset = 0;  // td with which the IMU samples were cut at this image [s]

  Eigen::Vector2d At(double td) const { return xy - (td - cut_time_offset) * velocity; }
};

}  // namespace plm_vins
