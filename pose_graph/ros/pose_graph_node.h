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
#include "common/ros/optional_node.h"
#include "common/ros/publisher_watch.h"
#include "common/ros/stream_monitor.h"
#include "common/streams/bounded_queue.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/loop_tally.h"
#include "pose_graph/ros/keyframe_images.h"
#include "pose_graph/ros/keyframe_input.h"

namespace plm_vins {

// Loop closure under ROS, as a node or in a nodelet: the keyframes of an estimator, ours or that of
// VINS-Mono, and the images in; tf map -> world, ~odometry, ~path, ~graph and ~match_image out.
// Keyframes are put together in the thread that receives their messages; a thread of its own looks
// for loops and optimises. No callback waits for it, but those of the services and of displays that
// begin to listen: where it cannot keep up, the oldest keyframes go. ~image_transport: as of
// ImageSubscription.
//
// A new world of odometry begins where it says so (restart), and where its messages begin to come
// from another process: from an estimator that was started again, or a recording played again.
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
  using OdometryEvent = ros::MessageEvent<const nav_msgs::Odometry>;

  enum WatchedTopic { kKeyframePoses, kOdometry, kWatchedTopics };

  struct WaitingKeyframe {
    OdometryFrame frame;
    int world = 0;  // of its pose
  };

  void AdvertiseMap();
  void Subscribe();
  template <typename Parameter>
  ros::Subscriber Receive(const std::string& topic,
                          const boost::function<void(Parameter)>& callback);
  template <typename Parameter>
  ros::Subscriber Receive(const std::string& topic, void (PoseGraphNode::*add)(Parameter));
  void TakeIn(const std::function<void()>& add);
  void PassOnInMap(const OdometryEvent& event);
  void PublishInMap(const nav_msgs::Odometry& odometry, const MapFix& fix);

  // With input_mutex_ held.
  void AddImage(const std::optional<ImageSample>& image);
  void AddCamera(const sensor_msgs::CameraInfo& message);
  void AddExtrinsics(const nav_msgs::Odometry& message);
  void AddPose(const OdometryEvent& event);
  void AddPoints(const sensor_msgs::PointCloud& message);
  void AddLines(const sensor_msgs::PointCloud& message);
  // Returns what to pass it on with, where its place in the map is known.
  std::optional<MapFix> AddOdometry(const OdometryEvent& event);
  void Restart(const std_msgs::Bool& message);
  void NoteNewWorld(const std::string& reason);
  void BeginWorld();
  void PassOn();
  DropCounts Drops() const;

  // In the thread of the services and timers.
  bool SaveMapFile(Trigger::Request& request, Trigger::Response& response);
  bool LoadMapFile(Trigger::Request& request, Trigger::Response& response);
  bool Reset(Trigger::Request& request, Trigger::Response& response);
  void StartWith(KeyframeMap map);
  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void ReportState(diagnostic_updater::DiagnosticStatusWrapper* status);

  // In the worker thread; where a map begins, in that of the services.
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
  ros::NodeHandle receiver_;  // its callbacks run in place
  const Config config_;
  const std::shared_ptr<const CameraModel> camera_;
  const std::string map_file_;

  StreamMonitor keyframe_stream_{"keyframes"};
  StreamMonitor odometry_stream_{"odometry"};

  std::mutex input_mutex_;  // never held for long; before the others, where two are held
  KeyframeInput input_;
  PublisherWatch estimator_{kWatchedTopics};
  int64_t keyframes_too_late_ = 0;
  DropWarner drop_warner_;

  ErrorCounter errors_;
  BoundedQueue<WaitingKeyframe> queue_;

  std::mutex loops_mutex_;  // held while a keyframe is worked on
  std::unique_ptr<LoopCloser> loops_;
  int map_world_ = 0;           // of its newest keyframe; older ones are of the map before
  KeyframeImages images_;       // of its keyframes
  bool shows_matches_ = false;  // somebody has asked for them

  // What is needed at once, whatever is worked on.
  struct Status {
    std::optional<MapFix> fix;
    int keyframes = 0;
    LoopTally loops;
    double keyframe_ms = 0;  // of the last keyframe
  };
  std::mutex status_mutex_;  // never held for long
  Status status_;
  int world_ = 0;  // that odometry is in now, changed with input_mutex_ held, too

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
  ImageSubscription image_subscription_;
  ros::WallTimer diagnostics_timer_;
};

struct LoopClosureSwitch {
  static constexpr char kKey[] = "loop_closure";
  static bool IsOn(const Config& config) { return config.pose_graph.loop_closure; }
};

using OptionalPoseGraphNode = OptionalNode<PoseGraphNode, LoopClosureSwitch>;

}  // namespace plm_vins
