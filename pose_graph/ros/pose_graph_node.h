// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/config/config.h"
#include "common/ros/image_subscription.h"
#include "common/ros/in_place_queue.h"
#include "common/ros/node_setup.h"
#include "common/ros/publisher_watch.h"
#include "common/ros/stream_monitor.h"
#include "common/streams/bounded_queue.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/loop_tally.h"
#include "pose_graph/ros/keyframe_images.h"
#include "pose_graph/ros/keyframe_input.h"

namespace plm_vins {

// Loop closure under ROS, as a node or nodelet. Subscribes to the images and to the keyframes of an
// estimator (that of this package or VINS-Mono). Publishes tf map -> world, ~odometry, ~path,
// ~graph and ~match_image. The receiving thread assembles keyframes; a worker thread searches for
// loops and optimizes. Only the callbacks of services and of new subscribers wait for the worker.
// If it cannot keep up, the oldest keyframes are dropped. For ~image_transport see
// ImageSubscription.
//
// A new odometry world begins when odometry announces it (restart), and when its messages come from
// another process: the estimator was restarted, or a recording is replayed.
//
// Services: ~save_map and ~load_map use the file named in the configuration (or parameter
// ~map_file); ~reset starts an empty map.
class PoseGraphNode {
 public:
  // Throws std::runtime_error if the configured previous map cannot be read.
  PoseGraphNode(const Config& config, const ros::NodeHandle& node,
                const ros::NodeHandle& private_node);
  ~PoseGraphNode();

 private:
  using Trigger = std_srvs::Trigger;
  using OdometryEvent = ros::MessageEvent<const nav_msgs::Odometry>;

  enum WatchedTopic { kKeyframePoses, kOdometry, kWatchedTopics };

  struct WaitingKeyframe {
    OdometryFrame frame;
    int world = 0;  // odometry world of its pose
  };

  void AdvertiseMap();
  void Subscribe();
  void SubscribeToCameras();
  template <typename Parameter>
  ros::Subscriber Receive(const std::string& topic,
                          const boost::function<void(Parameter)>& callback);
  template <typename Parameter>
  ros::Subscriber Receive(const std::string& topic, void (PoseGraphNode::*add)(Parameter));
  void TakeIn(const std::function<void()>& add);
  void PassOnInMap(const OdometryEvent& event);
  void PublishInMap(const nav_msgs::Odometry& odometry, const MapFix& fix);

  // These are called with input_mutex_ held.
  void AddImage(int camera, const std::optional<ImageSample>& image);
  void AddPose(const OdometryEvent& event);
  void AddPoints(const sensor_msgs::PointCloud& message);
  void AddLines(const sensor_msgs::PointCloud& message);
  // Returns the fix to publish the pose with, or nullopt if the pose in the map is unknown.
  std::optional<MapFix> AddOdometry(const OdometryEvent& event);
  void Restart(const std_msgs::Bool& message);
  void NoteNewWorld(const std::string& reason);
  void BeginWorld();
  void PassOn();
  DropCounts Drops() const;

  // These run in the thread of the services and timers.
  bool SaveMapFile(Trigger::Request& request, Trigger::Response& response);
  bool LoadMapFile(Trigger::Request& request, Trigger::Response& response);
  bool Reset(Trigger::Request& request, Trigger::Response& response);
  void StartWith(KeyframeMap map);
  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void ReportState(diagnostic_updater::DiagnosticStatusWrapper* status);

  // These run in the worker thread, or in that of the services when a map is loaded.
  void Work();
  void AddToMap(WaitingKeyframe* keyframe);
  void UpdateStatus(const LoopClosure& closure, int world, double milliseconds);
  void Remember(const OdometryFrame& frame);
  nav_msgs::Path Path() const;
  visualization_msgs::MarkerArray Graph() const;
  void PublishMap();
  void PublishMatch(const OdometryFrame& frame, const LoopClosure& closure);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  InPlaceQueue in_place_;
  ros::NodeHandle receiver_;  // its callbacks run in the receiving thread
  const Config config_;
  const CameraModels cameras_;
  const std::string map_file_;

  StreamMonitor keyframe_stream_{"keyframes"};
  StreamMonitor odometry_stream_{"odometry"};

  std::mutex input_mutex_;  // held briefly only; lock order: before the other mutexes
  KeyframeInput input_;
  PublisherWatch estimator_{kWatchedTopics};
  int64_t keyframes_too_late_ = 0;
  DropWarner drop_warner_;

  ErrorCounter errors_;
  BoundedQueue<WaitingKeyframe> queue_;

  std::mutex loops_mutex_;  // held while a keyframe is processed
  std::unique_ptr<LoopCloser> loops_;
  int map_world_ = 0;      // world of the newest keyframe; older worlds belong to the previous map
  KeyframeImages images_;  // images of the map's keyframes
  bool shows_matches_ = false;  // ~match_image has been subscribed to

  // Data that must be available without waiting for the worker.
  struct Status {
    std::optional<MapFix> fix;
    int keyframes = 0;
    LoopTally loops;
    double keyframe_ms = 0;  // processing time of the last keyframe
  };
  std::mutex status_mutex_;  // held briefly only
  Status status_;
  int world_ = 0;  // current odometry world; changed with input_mutex_ held as well

  ros::Publisher odometry_publisher_;
  ros::Publisher path_publisher_;
  ros::Publisher graph_publisher_;
  ros::Publisher match_publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  diagnostic_updater::Updater diagnostics_;
  std::thread worker_;

  // Declared last, so that they are destroyed first and no callback runs during destruction.
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::Subscriber> subscribers_;
  // One for each described camera; that of camera 0 comes first.
  std::vector<std::unique_ptr<ImageSubscription>> image_subscriptions_;
  ros::WallTimer diagnostics_timer_;
};

// Returns a PoseGraphNode, or nullptr if the configuration disables loop closure.
std::shared_ptr<void> MakePoseGraphNode(const Config& config, const ros::NodeHandle& node,
                                        const ros::NodeHandle& private_node);

}  // namespace plm_vins
