// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/output_conversion.h"

#include <cmath>

#include "common/ros/geometry_conversion.h"
#include "common/ros/marker.h"
#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

// Returns `covariance` if it is valid, otherwise a diagonal of kUnknownVariance.
template <typename Matrix>
Matrix ValidOrUnknown(const Matrix& covariance) {
  const bool valid = covariance.allFinite() && covariance.diagonal().minCoeff() > 0;
  return valid ? covariance : Matrix(kUnknownVariance * Matrix::Identity());
}

}  // namespace

StateCovariance CovarianceOf(const EstimatedFrame& frame) {
  const double rate_variance = frame.angular_velocity_variance;
  StateCovariance covariance;
  covariance.angular_velocity =
      std::isfinite(rate_variance) && rate_variance > 0 ? rate_variance : kUnknownVariance;
  const auto& known = frame.output.uncertainty;
  covariance.pose = ValidOrUnknown(known ? known->pose : Matrix6d(Matrix6d::Zero()));
  covariance.velocity =
      ValidOrUnknown(known ? known->body_velocity : Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
  return covariance;
}

nav_msgs::Odometry ToOdometry(const FrameState& state, const StateCovariance& covariance,
                              const Eigen::Vector3d& angular_velocity, const OutputConfig& frames) {
  nav_msgs::Odometry odometry =
      ToOdometry(state.t_ns, state.T_W_B(), frames.world_frame, frames.body_frame);
  const Eigen::Matrix3d R_W_B = state.T_W_B().R();
  SetCovariance(covariance.pose, &odometry.pose);
  odometry.twist.twist.linear = ToVector3(R_W_B.transpose() * state.velocity());
  odometry.twist.twist.angular = ToVector3(angular_velocity);
  Eigen::Map<RowMajor6d> twist(odometry.twist.covariance.data());
  twist.topLeftCorner<3, 3>() = covariance.velocity;
  twist.diagonal().tail<3>().setConstant(covariance.angular_velocity);
  return odometry;
}

nav_msgs::Odometry ToOdometry(int64_t t_ns, const Rigid3d& T_parent_child,
                              const std::string& parent, const std::string& child) {
  nav_msgs::Odometry odometry;
  odometry.header = MakeHeader(t_ns, parent);
  odometry.child_frame_id = child;
  odometry.pose.pose = ToPose(T_parent_child);
  return odometry;
}

sensor_msgs::PointCloud ToPointCloud(const std::vector<MapPoint>& points, int64_t t_ns,
                                     const std::string& frame_id) {
  sensor_msgs::PointCloud cloud = EmptyCloud(t_ns, frame_id);
  cloud.points.reserve(points.size());
  for (const MapPoint& point : points) {
    cloud.points.push_back(ToPoint32(point.p_W));
  }
  return cloud;
}

visualization_msgs::Marker ToKeyPoses(const std::vector<FrameState>& window, int64_t t_ns,
                                      const std::string& frame_id) {
  visualization_msgs::Marker marker = MakeMarker(MakeHeader(t_ns, frame_id), "key_poses",
                                                 visualization_msgs::Marker::SPHERE_LIST, 0.05);
  marker.color.r = 1.0;
  for (const FrameState& state : window) marker.points.push_back(ToPoint(state.position()));
  return marker;
}

visualization_msgs::MarkerArray ToCameraVisual(const Rigid3d& T_W_C, int64_t t_ns,
                                               const std::string& frame_id) {
  constexpr double kWidth = 0.2, kHeight = 0.13, kDepth = 0.15;  // [m]
  visualization_msgs::Marker marker = MakeMarker(MakeHeader(t_ns, frame_id), "camera_pose_visual",
                                                 visualization_msgs::Marker::LINE_LIST, 0.02);
  marker.color.g = 1.0;
  marker.pose = ToPose(T_W_C);
  const Eigen::Vector3d center = Eigen::Vector3d::Zero();
  const Eigen::Vector3d corners[4] = {{-kWidth, -kHeight, kDepth},
                                      {kWidth, -kHeight, kDepth},
                                      {kWidth, kHeight, kDepth},
                                      {-kWidth, kHeight, kDepth}};
  for (int i = 0; i < 4; ++i) {
    for (const Eigen::Vector3d& p : {center, corners[i], corners[i], corners[(i + 1) % 4]}) {
      marker.points.push_back(ToPoint(p));
    }
  }
  visualization_msgs::MarkerArray markers;
  markers.markers.push_back(marker);
  return markers;
}

}  // namespace plm_vins
