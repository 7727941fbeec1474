// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/config/config.h"
#include "common/finding.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/image_conversion.h"
#include "common/ros/image_subscription.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/names.h"
#include "common/ros/node_setup.h"
#include "common/ros/silent_topic.h"
#include "common/ros/stream_monitor.h"
#include "common/streams/constant_stamp.h"
#include "common/streams/drop_counts.h"
#include "tracking/image_schedule.h"
#include "tracking/ros/imu_inbox.h"

namespace plm_vins {

// The differences between the nodes of the trackers.
template <typename Tracker>
struct TrackerTraits {
  const char* feature_topic;
  const char* annotated_topic;
  const char* status;  // name of the diagnostics
  bool every_image;    // features of all images are published, not only those at the rate `freq`
  bool uses_depth;
  // Describes what seems to be wrong with the images.
  std::function<std::string(const Tracker&)> finding;
};

// A tracker under ROS, as a node or nodelet. Subscribes to images and the IMU (optional); publishes
// features, an annotated image and ~restart. All callbacks run in the queue of the two node
// handles, one at a time. Images that arrive while one is tracked are taken before the next one is
// tracked, so that a stall of the transport loses none; images that are older than kMaxWait are
// dropped then. `Stage` is a TrackingStage.
template <typename Stage>
class TrackerNode {
 public:
  TrackerNode(const Config& config, const ros::NodeHandle& node,
              const ros::NodeHandle& private_node,
              const TrackerTraits<typename Stage::Tracker>& traits)
      : node_(node),
        private_node_(private_node),
        config_(config),
        traits_(traits),
        stage_(config, kMaxWait),
        schedule_(config.publish_rate),
        diagnostics_(node, private_node, private_node.getNamespace()) {
    feature_publisher_ =
        private_node_.advertise<sensor_msgs::PointCloud>(traits.feature_topic, kOutputQueue);
    restart_publisher_ = private_node_.advertise<std_msgs::Bool>("restart", 10);
    for (const int camera : stage_.tracked_cameras()) {
      annotated_publishers_.push_back(
          private_transport_.advertise(NameOfCamera(traits.annotated_topic, camera), 10));
    }
    flush_timer_ = node_.createWallTimer(ros::WallDuration(0.1 * kMaxWaitForImu),
                                         [this](const ros::WallTimerEvent&) { FlushLateImages(); });
    diagnostics_.setHardwareID("none");
    diagnostics_.add(traits.status, this, &TrackerNode::ReportStatus);
    diagnostics_timer_ =
        node_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
          silence_.Check(images_.topic(), images_.type(), images_.stream());
          diagnostics_.force_update();
        });
    SubscribeToOthers();
    images_.Subscribe(node_, private_node_, config_.sensor.cameras[0].image_topic, kImageQueue,
                      [this](std::optional<ImageSample> image) { AddImage(std::move(image)); });
  }

 private:
  static constexpr uint32_t kOutputQueue = 200;
  // Images that arrive while one is tracked; more than those of kMaxWait.
  static constexpr uint32_t kImageQueue = 100;
  static constexpr double kMaxWait = 0.5;  // as in the estimator (ImageQueue) [s]
  // Wall time after which an image is tracked without the gyroscope [s].
  static constexpr double kMaxWaitForImu = 0.5;

  void SubscribeToOthers() {
    const SensorConfig& sensor = config_.sensor;
    for (int camera = 1; camera < static_cast<int>(sensor.cameras.size()); ++camera) {
      const std::string name = "camera" + std::to_string(camera) + "_images";
      const auto add = [this, camera](std::optional<ImageSample> image) {
        if (image) stage_.AddImage(camera, std::move(*image));
        ScheduleTracking();
      };
      other_images_.push_back(std::make_unique<ImageSubscription>(name));
      other_images_.back()->Subscribe(
          node_, private_node_, sensor.cameras[camera].image_topic, kImageQueue, add,
          [this, camera](int64_t t_ns) { return schedule_.IsNeeded(camera, t_ns); });
    }
    if (sensor.depth && traits_.uses_depth) {
      depth_subscriber_ = node_.subscribe<sensor_msgs::Image>(
          sensor.depth->topic, kImageQueue,
          [this](const sensor_msgs::ImageConstPtr& message) { AddDepth(message); });
    }
  }

  void AddDepth(const sensor_msgs::ImageConstPtr& message) {
    depth_stream_.Add(ToNanoseconds(message->header.stamp));
    try {
      stage_.AddDepth(ToDepthSample(message));
    } catch (const std::invalid_argument& error) {
      unreadable_depth_.Add(error.what());
    }
    ScheduleTracking();
  }

  void ScheduleTracking() {
    if (!std::exchange(tracking_is_due_, true)) imu_.RequestNotice();
  }

  // Tracks the next image, unless it still waits for IMU samples or other images.
  void TrackNext() {
    tracking_is_due_ = false;
    for (const ImuSample& sample : imu_.Take()) stage_.AddImu(sample);
    const bool is_done = Track([this] { return stage_.Pop(); });
    if (is_done || (stage_.waiting() && !imu_.WaitForNext())) ScheduleTracking();
  }

  void AddImage(std::optional<ImageSample> image) {
    last_image_arrival_ = ros::WallTime::now();
    if (image) CheckStamp(image->t_ns);
    if (image) stage_.AddImage(0, std::move(*image));
    ScheduleTracking();
    drop_warner_.Check(Drops());
  }

  void CheckStamp(int64_t t_ns) {
    image_stamps_.Add(t_ns);
    const std::string fault = image_stamps_.Finding(images_.topic());
    if (stamp_faults_.Set(t_ns, fault)) ROS_WARN_STREAM(fault);
  }

  // Publishes the frame that `next` returns; returns false if there is none. Tracks may be
  // inconsistent after an error, so they are dropped.
  template <typename NextFrame>
  bool Track(const NextFrame& next) {
    bool found = true;
    const bool done = errors_.Run([&] {
      const auto frame = next();
      found = frame.has_value();
      if (frame) Publish(*frame);
    });
    if (!done) stage_.Reset();
    return found;
  }

  void FlushLateImages() {
    if (ros::WallTime::now() - last_image_arrival_ < ros::WallDuration(kMaxWaitForImu)) return;
    while (Track([this] { return stage_.Flush(); })) {
    }
  }

  void Publish(const typename Stage::Frame& frame) {
    if (frame.restart) {
      ROS_WARN("image timestamps jumped back: tracking restarts");
      std_msgs::Bool restart;
      restart.data = true;
      restart_publisher_.publish(restart);
    }
    const sensor_msgs::PointCloud message = ToMessage(frame.features, config_.output.camera_frame);
    features_in_last_image_ = message.points.size();
    last_tracked_ = ros::WallTime::now();
    tracking_ms_ = frame.tracking_ms;
    image_faults_.Set(frame.features.t_ns, stage_.Finding(traits_.finding));
    if (!frame.publish && !traits_.every_image) return;
    feature_publisher_.publish(message);
    feature_stream_.Add(frame.features.t_ns);
    for (size_t i = 0; config_.show_track && i < annotated_publishers_.size(); ++i) {
      if (annotated_publishers_[i].getNumSubscribers() == 0) continue;
      annotated_publishers_[i].publish(
          ToMessage(stage_.DrawTracks(i), frame.features.t_ns, config_.output.camera_frame));
    }
  }

  DropCounts Drops() {
    DropCounts drops = {images_.unreadable(), errors_.count()};
    for (const auto& images : other_images_) drops.push_back(images->unreadable());
    if (depth_subscriber_) drops.push_back(unreadable_depth_);
    Append(ToDropCounts(stage_.counts()), &drops);
    drops.push_back(
        {"images_too_late", stage_.counts().too_late, images_.stream().DescribeStall()});
    return drops;
  }

  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (images_.stream().Silence() > StreamMonitor::kSilence) {
      status.summary(DiagnosticStatus::WARN, "waiting: no messages on " + images_.topic());
    } else if ((ros::WallTime::now() - last_tracked_).toSec() > StreamMonitor::kSilence) {
      status.summary(DiagnosticStatus::WARN, stage_.counts().images == 0
                                                 ? "waiting: no usable image yet"
                                                 : "waiting: no usable image any more");
    } else if (features_in_last_image_ == 0) {
      status.summary(DiagnosticStatus::WARN, "lost: no features in the last image");
    } else {
      const Finding finding = ImageFinding();
      status.summary(finding.is_present ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                     finding.is_present     ? finding.text
                     : finding.text.empty() ? "tracking"
                                            : "tracking; " + finding.text);
    }
    status.add("images", stage_.counts().images);
    status.add("features", features_in_last_image_);
    status.add("tracking_ms", tracking_ms_);
    for (StreamMonitor* stream : {&images_.stream(), &imu_.stream(), &feature_stream_}) {
      stream->Report(&status);
    }
    for (const auto& images : other_images_) images->stream().Report(&status);
    if (depth_subscriber_) depth_stream_.Report(&status);
    for (const DropCount& drop : Drops()) status.add(drop.cause, drop.count);
  }

  // Describes what seems to be wrong with the images, or was.
  Finding ImageFinding() {
    for (const auto& images : other_images_) {
      if (images->stream().Silence() > StreamMonitor::kSilence) {
        return {"no messages on " + images->topic() + ": its camera is not used", true};
      }
    }
    if (depth_subscriber_ && depth_stream_.Silence() > StreamMonitor::kSilence) {
      return {"depth: no messages on " + depth_subscriber_.getTopic(), true};
    }
    return stamp_faults_.finding().is_present ? stamp_faults_.finding() : image_faults_.finding();
  }

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  image_transport::ImageTransport private_transport_{private_node_};

  const Config config_;
  const TrackerTraits<typename Stage::Tracker> traits_;
  Stage stage_;
  ImageSchedule schedule_;
  DropWarner drop_warner_;
  ConstantStamp image_stamps_;
  FindingMemory stamp_faults_, image_faults_;
  bool tracking_is_due_ = false;  // TrackNext() is in the queue of callbacks
  SilenceWarner silence_;
  ErrorCounter errors_;
  size_t features_in_last_image_ = 0;
  double tracking_ms_ = 0;  // for the last image [ms]
  StreamMonitor feature_stream_{"features"};
  StreamMonitor depth_stream_{"depth"};
  DropCount unreadable_depth_{"depth_images_unreadable", 0, ""};

  ros::WallTime last_image_arrival_ = ros::WallTime::now();
  ros::WallTime last_tracked_ = ros::WallTime::now();
  ros::Publisher feature_publisher_;
  ros::Publisher restart_publisher_;
  std::vector<image_transport::Publisher> annotated_publishers_;  // by tracked camera
  diagnostic_updater::Updater diagnostics_;

  // Declared last, so that they are destroyed first, and the inbox after the others: a nodelet is
  // unloaded while callbacks run in other threads. Each destructor waits for its own callbacks.
  // Callbacks of images and timers use the IMU inbox. Its own callback, in the receiving thread,
  // uses nothing else.
  ImuInbox imu_{node_, config_.sensor.imu_topic, [this] { TrackNext(); }};
  ImageSubscription images_;
  std::vector<std::unique_ptr<ImageSubscription>> other_images_;  // of cameras 1, 2, ...
  ros::Subscriber depth_subscriber_;
  ros::WallTimer flush_timer_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace plm_vins
