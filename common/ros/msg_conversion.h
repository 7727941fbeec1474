// SPDX-License-Identifier: BSD-3-Clause
// Measurements and transforms to ROS messages and back: the only place that knows their layout, but
// for images (see image_conversion.h).
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>

#include <optional>
#include <string>

#include "common/geometry/rigid3.h"
#include "common/measurements.h"

namespace plm_vins {

inline int64_t ToNanoseconds(const ros::Time& stamp) {
  return static_cast<int64_t>(stamp.sec) * 1'000'000'000 + stamp.nsec;
}
ros::Time ToRosTime(int64_t t_ns);

ImuSample ToImuSample(const sensor_msgs::Imu& message);

// /feature_tracker/feature as in VINS-Mono: points (x, y, 1), channels id, u, v, vx, vy. Ids travel
// modulo kTransportableIds; IdRestorer takes that back. Reading takes the layouts of PL-VINS (id,
// u, v) and VINS-Fusion (id, camera, u, v, vx, vy, ...) as well, of the latter the points of camera
// 0 alone. It throws std::invalid_argument where channels are missing and where an id is none that
// travels; what RemoveImpossible() would remove is left out, and `left_out` grows by its number.
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

geometry_msgs::Point ToPoint(const Eigen::Vector3d& p);
geometry_msgs::Vector3 ToVector3(const Eigen::Vector3d& v);
geometry_msgs::Quaternion ToQuaternion(const Eigen::Quaterniond& q);
geometry_msgs::Pose ToPose(const Rigid3d& T);
geometry_msgs::Transform ToTransform(const Rigid3d& T);
Rigid3d ToRigid(const geometry_msgs::Pose& pose);
Rigid3d ToRigid(const geometry_msgs::Transform& transform);

// How messages of poses and twists lay out a covariance.
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

// A variance as large stands for one that is not known, in SI units, as in MAVLink.
constexpr double kUnknownVariance = 1e6;

// The covariance of a message's pose T_W_B, as (p_W, theta_B), R_W_B Exp(theta_B): the message has
// it about the axes of W. Nothing where it is not known.
std::optional<Eigen::Matrix<double, 6, 6>> CovarianceOf(
    const geometry_msgs::PoseWithCovariance& pose);
void SetCovariance(const Eigen::Matrix<double, 6, 6>& covariance,
                   geometry_msgs::PoseWithCovariance* pose);

sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, const std::string& frame_id);

}  // namespace plm_vins
