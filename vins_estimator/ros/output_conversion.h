// SPDX-License-Identifier: BSD-3-Clause
// Conversions of the estimator's output to messages.
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "common/config/config.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {

// Covariances of a state, in the frames of EstimatorOutput.
struct StateCovariance {
  Matrix6d pose = Matrix6d::Zero();                    // p_W, rotation in B (right perturbation)
  Eigen::Matrix3d velocity = Eigen::Matrix3d::Zero();  // v_B
  double angular_velocity = 0;                         // variance of each component, in B
};

// Returns the covariances; very large values if unknown, since zeros would mean perfect certainty.
StateCovariance CovarianceOf(const EstimatedFrame& frame);

// Converts a state to pose in the world and, as the message requires, twist in the body frame; both
// covariances are in the frames of the message. `angular_velocity` is that of B in B [rad/s].
nav_msgs::Odometry ToOdometry(const FrameState& state, const StateCovariance& covariance,
                              const Eigen::Vector3d& angular_velocity, const OutputConfig& frames);

// Converts a pose without twist and covariances.
nav_msgs::Odometry ToOdometry(int64_t t_ns, const Rigid3d& T_parent_child,
                              const std::string& parent, const std::string& child);

sensor_msgs::PointCloud ToPointCloud(const std::vector<MapPoint>& points, int64_t t_ns,
                                     const std::string& frame_id);

// Converts the positions of the window's keyframes to spheres.
visualization_msgs::Marker ToKeyPoses(const std::vector<FrameState>& window, int64_t t_ns,
                                      const std::string& frame_id);

// Converts a camera pose to a small pyramid of lines.
visualization_msgs::MarkerArray ToCameraVisual(const Rigid3d& T_W_C, int64_t t_ns,
                                               const std::string& frame_id);

}  // namespace plm_vins
