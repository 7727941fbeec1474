// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <mutex>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/ros/robot_base.h"
#include "vins_estimator/estimation_stage.h"
#include "vins_estimator/ros/line_markers.h"

namespace plm_vins {

// Publishes what the estimator says about an image, under the node's private namespace: odometry,
// path, camera_pose, key_poses, point_cloud, history_cloud, lines_cloud, history_lines_cloud,
// camera_pose_visual, extrinsic, what a pose graph takes (camera_info, keyframe_pose,
// keyframe_point, keyframe_line, and restart where another world begins), and tf2 world -> body ->
// camera, world -> manhattan once known. In a robot's own tree, which base_frame names, tf2 has
// world -> base instead of body and camera. The histories have, as in VINS-Mono and PL-VINS, the
// landmarks that leave the window, those of one second in a message. Messages that nobody listens
// to are not sent, but for odometry, tf and the path. A display that is opened later has the whole
// path and all lines of the past: the latter come by a callback of the node's queue. All else is
// for one thread.
class OutputPublisher {
 public:
  OutputPublisher(const OutputConfig& frames, ros::NodeHandle private_node);

  void Publish(const EstimatedFrame& frame);

  // Forgets path and lines: another world frame begins.
  void Clear();

 private:
  ros::Publisher AdvertiseLineHistory(ros::NodeHandle private_node);
  void PublishPath(const FrameState& state);
  void PublishKeyframe(const EstimatedFrame& frame);
  void PublishHistory(const EstimatorOutput& output);
  void PublishLineHistory(int64_t t_ns);
  void PublishTransforms(const EstimatorOutput& output);
  std::vector<geometry_msgs::TransformStamped> BodyTransforms(const EstimatorOutput& output);

  OutputConfig frames_;
  std::mutex history_mutex_;  // guards line_history_, and the order in which it is sent
  LineHistory line_history_;
  // What waits to be sent goes in this order: a new world before its first pose.
  ros::Publisher restart_;
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
  ros::Publisher camera_info_;
  ros::Publisher keyframe_line_;
  ros::Publisher keyframe_point_;
  ros::Publisher keyframe_pose_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::optional<RobotBase> base_;
  nav_msgs::Path path_;
  int new_path_poses_ = 0;                 // since it was published
  std::vector<MapPoint> departed_points_;  // since history_ns_, when the histories were published
  std::vector<MapLine> departed_lines_;
  std::vector<int64_t> absorbed_lines_;
  int64_t history_ns_ = 0;
};

}  // namespace plm_vins
