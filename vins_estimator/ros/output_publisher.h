// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include "common/config.h"
#include "vins_estimator/estimation_stage.h"
#include "vins_estimator/ros/line_markers.h"

namespace plm_vins {

// Publishes what the estimator says about an image, under the node's private namespace: odometry,
// path, camera_pose, key_poses, point_cloud, history_cloud, lines_cloud, history_lines_cloud,
// camera_pose_visual, extrinsic, and tf2 world -> body -> camera, world -> manhattan once known.
// The histories have, as in VINS-Mono and PL-VINS, the landmarks that leave the window with this
// image. Messages that nobody listens to are not made. For one thread.
class OutputPublisher {
 public:
  OutputPublisher(const OutputConfig& frames, ros::NodeHandle private_node);

  void Publish(const EstimatedFrame& frame);

  // Forgets path and lines: another world frame begins.
  void Clear();

 private:
  void PublishPath(const FrameState& state);
  void PublishLines(const EstimatorOutput& output);
  void PublishTransforms(const EstimatorOutput& output);

  OutputConfig frames_;
  ros::Publisher odometry_;
  ros::Publisher path_publisher_;
  ros::Publisher camera_pose_;
  ros::Publisher key_poses_;
  ros::Publisher point_cloud_;
  ros::Publisher history_cloud_;
  ros::Publisher lines_cloud_;
  ros::Publisher history_lines_cloud_;
  ros::Publisher camera_pose_visual_;
  ros::Publisher extrinsic_;
  tf2_ros::TransformBroadcaster broadcaster_;
  nav_msgs::Path path_;
  LineHistory line_history_;
};

}  // namespace plm_vins
