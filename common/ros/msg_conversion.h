// SPDX-License-Identifier: BSD-3-Clause
// Measurements to ROS messages and back: the only place that knows their layout, but for images
// (see image_conversion.h).
#pragma once

#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>

#include <string>

#include "common/measurements.h"

namespace plm_vins {

ImuSample ToImuSample(const sensor_msgs::Imu& message);

// /feature_tracker/feature as in VINS-Mono: points (x, y, 1), channels id, u, v, vx, vy. Ids travel
// modulo kTransportableIds; IdRestorer takes that back. Reading takes the layouts of PL-VINS (id,
// u, v) and VINS-Fusion (id, camera, u, v, vx, vy, ...) as well, of the latter the points of camera
// 0 alone. It throws std::invalid_argument where channels are missing, the stamp is none, or an id
// is none that travels; what RemoveImpossible() would remove is left out, and `left_out` grows by
// its number.
sensor_msgs::PointCloud ToMessage(const PointFrame& frame, const std::string& frame_id);
PointFrame ToPointFrame(const sensor_msgs::PointCloud& message, int64_t* left_out);

// False for the messages of PL-VINS: ToPointFrame() leaves the velocities zero.
inline bool HasVelocities(const sensor_msgs::PointCloud& points) {
  return points.channels.size() >= 5;
}

// /linefeature_tracker/linefeature as in PL-VINS: points are the starts (x, y, 1) of the lines,
// channels id, x_end, y_end.
sensor_msgs::PointCloud ToMessage(const LineFrame& frame, const std::string& frame_id);
LineFrame ToLineFrame(const sensor_msgs::PointCloud& message, int64_t* left_out);

sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, const std::string& frame_id);

}  // namespace plm_vins
