// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a calibrated camera to and from a message.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <string>

#include "common/camera/camera_model.h"

namespace plm_vins {

// K and D have the layout of image_geometry and camera_calibration_parsers: "plumb_bob" (k1, k2,
// p1, p2, 0) and "equidistant" (k1 to k4). ROS has no name for MEI; "mei" (k1, k2, p1, p2, xi) is
// used here.
sensor_msgs::CameraInfo ToCameraInfo(const CameraParameters& camera, int64_t t_ns,
                                     const std::string& frame_id);

// Throws std::invalid_argument if the distortion model is unknown or has too few coefficients.
CameraParameters ToCameraParameters(const sensor_msgs::CameraInfo& message);

}  // namespace plm_vins
