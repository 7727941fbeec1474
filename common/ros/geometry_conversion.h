// SPDX-License-Identifier: BSD-3-Clause
// Conversion of basic message types: timestamps, headers, points and poses.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Point32.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

inline int64_t ToNanoseconds(const ros::Time& stamp) {
  return static_cast<int64_t>(stamp.sec) * 1'000'000'000 + stamp.nsec;
}
ros::Time ToRosTime(int64_t t_ns);

std_msgs::Header MakeHeader(int64_t t_ns, const std::string& frame_id);

geometry_msgs::Point ToPoint(const Eigen::Vector3d& p);
geometry_msgs::Point32 ToPoint32(const Eigen::Vector3d& p);
geometry_msgs::Vector3 ToVector3(const Eigen::Vector3d& v);
geometry_msgs::Quaternion ToQuaternion(const Eigen::Quaterniond& q);
geometry_msgs::Pose ToPose(const Rigid3d& T);
geometry_msgs::Transform ToTransform(const Rigid3d& T);
// Transform of the child frame in the frame of the header.
geometry_msgs::TransformStamped ToTransform(const std_msgs::Header& header,
                                            const std::string& child_frame, const Rigid3d& T);
Rigid3d ToRigid(const geometry_msgs::Pose& pose);
Rigid3d ToRigid(const geometry_msgs::Transform& transform);

// Layout of covariances in pose and twist messages.
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

// A variance of at least this value means unknown (SI units), as in MAVLink.
constexpr double kUnknownVariance = 1e6;

// Covariance of a message's pose T_W_B as (p_W, theta_B) with R_W_B Exp(theta_B); the message has
// the rotation about the axes of W. Returns nullopt if it is unknown.
std::optional<Eigen::Matrix<double, 6, 6>> CovarianceOf(
    const geometry_msgs::PoseWithCovariance& pose);
void SetCovariance(const Eigen::Matrix<double, 6, 6>& covariance,
                   geometry_msgs::PoseWithCovariance* pose);

}  // namespace plm_vins
