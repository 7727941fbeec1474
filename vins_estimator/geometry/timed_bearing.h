// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// Time offset and readout time with which the corners of an image were brought to the time of the
// frame's state.
struct ImageTiming {
  double cut_time_offset = 0;  // td with which the IMU samples were cut at this image [s]
  double cut_readout = 0;      // rolling-shutter readout time by which the corners were moved [s]
  int image_height = 1;        // [px]
};

// Observation of a corner, extrapolated along its velocity v to the time of the frame's state: the
// state is at t_image + cut_time_offset and the image was taken at t_image + td, so at the state's
// time the corner is at xy - (td - cut_time_offset) v. A later correction of the rolling-shutter
// readout time delays the corner's row, which adds to td.
struct TimedBearing {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalized, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [1/s]
  double cut_time_offset = 0;                          // [s]
  double share = 0;        // position of its row in the readout: ReadoutShare()
  double cut_readout = 0;  // already compensated in xy [s]

  Eigen::Vector2d At(double td) const { return xy - (td - cut_time_offset) * velocity; }
  double Delay(double readout) const { return share * (readout - cut_readout); }  // [s]
};

}  // namespace plm_vins
