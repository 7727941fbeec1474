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

// Publishes the estimate of an image in the node's private namespace: odometry, path, camera_pose,
// key_poses, point_cloud, history_cloud, lines_cloud, history_lines_cloud, camera_pose_visual,
// extrinsic, the inputs of a pose graph (camera_info, keyframe_pose, keyframe_point, keyframe_line,
// and restart when a new world frame begins), and tf2 world -> body -> camera and, once known,
// world -> manhattan. Names that belong to a further camera have its number (extrinsic1, camera1).
// If base_frame names a frame of a robot's own tf tree, tf2 has world -> base instead of body and
// camera. As in VINS-Mono and PL-VINS, the history topics contain the landmarks that leave the
// window, one message per second. Messages without subscribers are not sent, except odometry, tf
// and path. A display that is opened later receives the whole path and all past lines, the latter
// by a callback of the node's queue; everything else must be called from one thread.
class OutputPublisher {
 public:
  OutputPublisher(const OutputConfig& frames, int cameras, ros::NodeHandle private_node);

  void Publish(const EstimatedFrame& frame);

  // Drops path and lines: a new world frame begins.
  void Clear();

 private:
  struct PerWorld {
    nav_msgs::Path path;
    int new_path_poses = 0;                 // since it was last published
    std::vector<MapPoint> departed_points;  // since history_ns
    std::vector<MapLine> departed_lines;
    std::vector<int64_t> absorbed_lines;
    int64_t history_ns = 0;  // last publication of the histories
  };

  ros::Publisher AdvertiseLineHistory(ros::NodeHandle private_node);
  std::string CameraFrame(size_t camera) const;
  void PublishPath(const FrameState& state);
  void PublishKeyframe(const EstimatedFrame& frame);
  void PublishHistory(const EstimatorOutput& output);
  void PublishLineHistory(int64_t t_ns);
  void PublishTransforms(const EstimatorOutput& output);
  std::vector<geometry_msgs::TransformStamped> BodyTransforms(const EstimatorOutput& output);

  OutputConfig frames_;
  std::mutex history_mutex_;  // guards line_history_ and the order of its messages
  LineHistory line_history_;
  // Pending messages are sent in this order: a new world frame before its first pose.
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
  std::vector<ros::Publisher> extrinsics_, camera_infos_;  // by camera
  ros::Publisher keyframe_line_;
  ros::Publisher keyframe_point_;
  ros::Publisher keyframe_pose_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::optional<RobotBase> base_;
  PerWorld world_;
};

}  // namespace plm_vins
