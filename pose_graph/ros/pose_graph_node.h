// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/bounded_queue.h"
#include "common/config.h"
#include "common/ros/node_setup.h"
#include "pose_graph/keyframe_assembly.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/ros/keyframe_images.h"

namespace plm_vins {

// Loop closure under ROS, as a node or in a nodelet: the keyframes of an estimator, ours or that of
// VINS-Mono, and the images in; tf map -> world, ~odometry, ~path, ~graph and ~match_image out.
// The callbacks put keyframes together; a thread of its own looks for loops and optimises. No
// callback waits for it, but those of the services.
//
// Services: ~save_map and ~load_map, to and from the file that the configuration names (parameter
// ~map_file: another one); ~reset starts an empty map.
class PoseGraphNode {
 public:
  // Throws std::runtime_error where a previous map is asked for and cannot be read.
  PoseGraphNode(const Config& config, const ros::NodeHandle& node,
                const ros::NodeHandle& private_node);
  ~PoseGraphNode();

 private:
  using Trigger = std_srvs::Trigger;

  // In the thread of the callbacks.
  void Subscribe();
  void AddImage(const sensor_msgs::ImageConstPtr& message);
  void AddCamera(const sensor_msgs::CameraInfo& message);
  void AddPose(const nav_msgs::Odometry& message);
  void AddPoints(const sensor_msgs::PointCloud& message);
  void AddLines(const sensor_msgs::PointCloud& message);
  void AddOdometry(const nav_msgs::Odometry& message);
  void Restart(const std_msgs::Bool& message);
  void PassOn();
  bool SaveMapFile(Trigger::Request& request, Trigger::Response& response);
  bool LoadMapFile(Trigger::Request& request, Trigger::Response& response);
  bool Reset(Trigger::Request& request, Trigger::Response& response);
  void StartWith(KeyframeMap map);
  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  // In the worker thread.
  void Work();
  void UpdateStatus(const LoopClosure& closure, double milliseconds);
  void Remember(const OdometryFrame& frame);
  void Publish(const OdometryFrame& frame, const LoopClosure& closure);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  const Config config_;
  const std::shared_ptr<const CameraModel> camera_;
  const std::string map_file_;

  KeyframeAssembly assembly_;  // for the callbacks, as what follows
  bool restarted_ = false;
  std::optional<CameraParameters> refined_camera_;  // by the estimator, where it says so
  ErrorCounter callback_errors_;
  BoundedQueue<OdometryFrame> queue_;

  std::mutex loops_mutex_;  // held while a keyframe is worked on
  std::unique_ptr<LoopCloser> loops_;
  KeyframeImages images_;  // of its keyframes

  // What the callbacks need at once, whatever is worked on.
  struct Status {
    std::optional<MapFix> fix;
    int keyframes = 0;
    int loops = 0;
    std::map<std::string, int> refused;  // candidates, by gate
    double keyframe_ms = 0;              // of the last keyframe
  };
  std::mutex status_mutex_;  // never held for long
  Status status_;

  ErrorCounter worker_errors_;  // for the worker
  ros::Publisher odometry_publisher_;
  ros::Publisher path_publisher_;
  ros::Publisher graph_publisher_;
  ros::Publisher match_publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  diagnostic_updater::Updater diagnostics_;
  std::thread worker_;

  // Last, so that no callback comes any more while the rest ends.
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace plm_vins
