// SPDX-License-Identifier: BSD-3-Clause
// A calibrated camera as a message.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <string>

#include "common/camera/camera_model.h"

namespace plm_vins {

// K and D as image_geometry and camera_calibration_parsers read them: "plumb_bob" (k1, k2, p1, p2,
// 0) and "equidistant" (k1 to k4). ROS has no name for MEI, here "mei" (k1, k2, p1, p2, xi).
sensor_msgs::CameraInfo ToCameraInfo(const CameraParameters& camera, int64_t t_ns,
                                     const std::string& frame_id);

// Throws std::invalid_argument for another distortion model, or with fewer coefficients than it
// has.
CameraParameters ToCameraParameters(const sensor_msgs::CameraInfo& message);

}  // namespace plm_vins
