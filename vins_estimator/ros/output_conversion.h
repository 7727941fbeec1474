// SPDX-License-Identifier: BSD-3-Clause
// What the estimator says, as messages.
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

// Covariances of a state, as EstimatorOutput has them.
struct StateCovariance {
  Matrix6d pose = Matrix6d::Zero();                    // p_W, rotation in B (right perturbation)
  Eigen::Matrix3d velocity = Eigen::Matrix3d::Zero();  // v_B
  double angular_velocity = 0;                         // of each component, in B
};

// Very large where the estimator has none: zeros would mean perfect knowledge.
StateCovariance CovarianceOf(const EstimatedFrame& frame);

// The pose of the body in the world and, as the message demands, its twist in the body frame; both
// covariances in the frames of the message. `angular_velocity` is that of B in B [rad/s].
nav_msgs::Odometry ToOdometry(const FrameState& state, const StateCovariance& covariance,
                              const Eigen::Vector3d& angular_velocity, const OutputConfig& frames);

// A pose alone.
nav_msgs::Odometry ToOdometry(int64_t t_ns, const Rigid3d& T_parent_child,
                              const std::string& parent, const std::string& child);

sensor_msgs::PointCloud ToPointCloud(const std::vector<MapPoint>& points, int64_t t_ns,
                                     const std::string& frame_id);

// Positions of the window's keyframes as spheres.
visualization_msgs::Marker ToKeyPoses(const std::vector<FrameState>& window, int64_t t_ns,
                                      const std::string& frame_id);

// The camera as a small pyramid of lines.
visualization_msgs::MarkerArray ToCameraVisual(const Rigid3d& T_W_C, int64_t t_ns,
                                               const std::string& frame_id);

}  // namespace plm_vins
