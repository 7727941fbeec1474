// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// With what an image's corners were brought to the time that the frame's state stands for.
struct ImageTiming {
  double cut_time_offset = 0;  // td with which the IMU was cut at this image [s]
  double cut_readout = 0;      // time of a rolling shutter with which they were moved [s]
  int image_height = 1;        // [px]
};

// One corner in one image, moved along its velocity v to the time that the frame's state stands
// for: the state was cut at t_image + cut_time_offset, the image was taken at t_image + td, so at
// the state's time the corner is at xy - (td - cut_time_offset) v. What is learned of a rolling
// shutter later delays the corner's row: that adds to td.
struct TimedBearing {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalised, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [1/s]
  double cut_time_offset = 0;                          // [s]
  double share = 0;                                    // of its row: ReadoutShare()
  double cut_readout = 0;                              // that xy makes up for already [s]

  Eigen::Vector2d At(double td) const { return xy - (td - cut_time_offset) * velocity; }
  double Delay(double readout) const { return share * (readout - cut_readout); }  // [s]
};

}  // namespace plm_vins
