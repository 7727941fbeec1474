// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

template <typename Message>
Message WithCoordinates(const Eigen::Vector3d& v) {
  using Coordinate = decltype(Message::x);
  Message message;
  message.x = static_cast<Coordinate>(v.x());
  message.y = static_cast<Coordinate>(v.y());
  message.z = static_cast<Coordinate>(v.z());
  return message;
}

template <typename Position>
Rigid3d ToRigid(const Position& p, const geometry_msgs::Quaternion& q) {
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(), {p.x, p.y, p.z}};
}

// Covariance of a pose whose rotation error is transformed from theta to R theta.
Eigen::Matrix<double, 6, 6> TurnRotation(const Eigen::Matrix3d& R,
                                         const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  J.bottomRightCorner<3, 3>() = R;
  return J * covariance * J.transpose();
}

}  // namespace

ros::Time ToRosTime(int64_t t_ns) {
  ros::Time stamp;
  stamp.fromNSec(static_cast<uint64_t>(t_ns));
  return stamp;
}

std_msgs::Header MakeHeader(int64_t t_ns, const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = ToRosTime(t_ns);
  header.frame_id = frame_id;
  return header;
}

geometry_msgs::Point ToPoint(const Eigen::Vector3d& p) {
  return WithCoordinates<geometry_msgs::Point>(p);
}

geometry_msgs::Point32 ToPoint32(const Eigen::Vector3d& p) {
  return WithCoordinates<geometry_msgs::Point32>(p);
}

geometry_msgs::Vector3 ToVector3(const Eigen::Vector3d& v) {
  return WithCoordinates<geometry_msgs::Vector3>(v);
}

geometry_msgs::Quaternion ToQuaternion(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion quaternion;
  quaternion.x = q.x();
  quaternion.y = q.y();
  quaternion.z = q.z();
  quaternion.w = q.w();
  return quaternion;
}

geometry_msgs::Pose ToPose(const Rigid3d& T) {
  geometry_msgs::Pose pose;
  pose.position = ToPoint(T.translation);
  pose.orientation = ToQuaternion(T.rotation);
  return pose;
}

geometry_msgs::Transform ToTransform(const Rigid3d& T) {
  geometry_msgs::Transform transform;
  transform.translation = ToVector3(T.translation);
  transform.rotation = ToQuaternion(T.rotation);
  return transform;
}

geometry_msgs::TransformStamped ToTransform(const std_msgs::Header& header,
                                            const std::string& child_frame, const Rigid3d& T) {
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = child_frame;
  transform.transform = ToTransform(T);
  return transform;
}

Rigid3d ToRigid(const geometry_msgs::Pose& pose) {
  return ToRigid(pose.position, pose.orientation);
}

Rigid3d ToRigid(const geometry_msgs::Transform& transform) {
  return ToRigid(transform.translation, transform.rotation);
}

std::optional<Eigen::Matrix<double, 6, 6>> CovarianceOf(
    const geometry_msgs::PoseWithCovariance& pose) {
  const Eigen::Map<const RowMajor6d> covariance(pose.covariance.data());
  if (covariance.diagonal().maxCoeff() >= kUnknownVariance) return std::nullopt;
  return TurnRotation(ToRigid(pose.pose).R().transpose(), covariance);
}

void SetCovariance(const Eigen::Matrix<double, 6, 6>& covariance,
                   geometry_msgs::PoseWithCovariance* pose) {
  Eigen::Map<RowMajor6d>(pose->covariance.data()) =
      TurnRotation(ToRigid(pose->pose).R(), covariance);
}

}  // namespace plm_vins
