// SPDX-License-Identifier: BSD-3-Clause
// Conversion of measurements to and from ROS messages; defines their layout (images:
// image_conversion.h).
#pragma once

#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>

#include <string>

#include "common/measurements.h"

namespace plm_vins {

ImuSample ToImuSample(const sensor_msgs::Imu& message);

// /feature_tracker/feature has VINS-Mono's format: points (x, y, 1), channels id, u, v, vx, vy;
// with observations of further cameras VINS-Fusion's: id, camera_id, u, v, vx, vy. A channel
// "depth" follows if any point has one. Ids are transmitted modulo kTransportableIds; IdRestorer
// restores them. Reading supports the layout of PL-VINS (id, u, v) as well. It throws
// std::invalid_argument if channels are missing or the timestamp or an id is invalid. It drops the
// observations that RemoveImpossible() removes, and adds their number to `left_out`.
sensor_msgs::PointCloud ToMessage(const PointFrame& frame, const std::string& frame_id);
PointFrame ToPointFrame(const sensor_msgs::PointCloud& message, int64_t* left_out);

// Returns false for the messages of PL-VINS, for which ToPointFrame() sets the velocities to zero.
inline bool HasVelocities(const sensor_msgs::PointCloud& points) {
  return points.channels.size() >= 5;
}

// /linefeature_tracker/linefeature has PL-VINS' format: points are the starts (x, y, 1) of the
// lines, channels id, x_end, y_end. With observations of further cameras the channels camera_id,
// deviation and deviation_end follow.
sensor_msgs::PointCloud ToMessage(const LineFrame& frame, const std::string& frame_id);
LineFrame ToLineFrame(const sensor_msgs::PointCloud& message, int64_t* left_out);

sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, const std::string& frame_id);

}  // namespace plm_vins
