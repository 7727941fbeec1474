// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Bool.h>

#include <stdexcept>
#include <string>

#include "common/config.h"
#include "common/ros/msg_conversion.h"
#include "common/ros/node_setup.h"

namespace plm_vins {

// What is particular to the node of one front end.
struct TrackerNodeOptions {
  std::string feature_topic;      // private, as is the topic of the annotated image
  std::string annotated_topic;    //
  std::string diagnostics;        // name of the status
  uint32_t image_queue_size = 1;  // images that wait while one is tracked; beyond, the oldest goes
};

// A front end as a node: images (and the IMU, where it comes) in; features, annotated image and
// ~restart out. One thread: images queue in their subscriber while one is tracked.
//
// ~image_transport: raw (default), compressed (decoded here, no plugin needed) or any plugin's
// name. `Stage` is a TrackingStage.
template <typename Stage>
class TrackerNode {
 public:
  TrackerNode(const Config& config, const TrackerNodeOptions& options)
      : config_(config), options_(options), stage_(config) {
    feature_publisher_ =
        private_node_.advertise<sensor_msgs::PointCloud>(options.feature_topic, kOutputQueue);
    restart_publisher_ = private_node_.advertise<std_msgs::Bool>("restart", 10);
    annotated_publisher_ = private_transport_.advertise(options.annotated_topic, 10);
    flush_timer_ = node_.createWallTimer(ros::WallDuration(0.5 * kMaxWaitForImu),
                                         [this](const ros::WallTimerEvent&) { FlushLateImages(); });
    diagnostics_.setHardwareID("none");
    diagnostics_.add(options.diagnostics, this, &TrackerNode::ReportStatus);
    diagnostics_timer_ =
        node_.createWallTimer(ros::WallDuration(1.0),
                              [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
    Subscribe();
  }

 private:
  static constexpr uint32_t kOutputQueue = 200;
  static constexpr uint32_t kImuQueue = 2000;
  // [s] of wall time: then an image is tracked without the gyro.
  static constexpr double kMaxWaitForImu = 0.1;

  void Subscribe() {
    const std::string topic = config_.sensor.image_topic;
    const auto transport = private_node_.param<std::string>("image_transport", "raw");
    if (transport == "compressed") {
      compressed_subscriber_ =
          node_.subscribe(topic + "/compressed", options_.image_queue_size,
                          &TrackerNode::AddImage<sensor_msgs::CompressedImage>, this);
    } else {
      image_subscriber_ = transport_.subscribe(
          topic, options_.image_queue_size,
          [this](const sensor_msgs::ImageConstPtr& message) { AddImage(*message); }, nullptr,
          image_transport::TransportHints(transport));
    }
    imu_subscriber_ = node_.subscribe(config_.sensor.imu_topic, kImuQueue, &TrackerNode::AddImu,
                                      this, ros::TransportHints().tcpNoDelay());
  }

  void AddImu(const sensor_msgs::Imu& message) {
    stage_.AddImu(ToImuSample(message));
    while (const auto frame = stage_.Pop()) Publish(*frame);
  }

  template <typename Image>
  void AddImage(const Image& message) {
    last_image_arrival_ = ros::WallTime::now();
    try {
      stage_.AddImage(ToImageSample(message));
    } catch (const std::invalid_argument& error) {
      if (unreadable_images_++ == 0) first_unreadable_ = error.what();
    }
    while (const auto frame = stage_.Pop()) Publish(*frame);
    drop_warner_.Check(Drops());
  }

  void FlushLateImages() {
    if (ros::WallTime::now() - last_image_arrival_ < ros::WallDuration(kMaxWaitForImu)) return;
    while (const auto frame = stage_.Flush()) Publish(*frame);
  }

  void Publish(const typename Stage::Frame& frame) {
    if (frame.restart) {
      std_msgs::Bool restart;
      restart.data = true;
      restart_publisher_.publish(restart);
    }
    const sensor_msgs::PointCloud message = ToMessage(frame.features, config_.output.camera_frame);
    features_in_last_image_ = message.points.size();
    if (!frame.publish) return;
    feature_publisher_.publish(message);
    if (config_.show_track && annotated_publisher_.getNumSubscribers() > 0) {
      annotated_publisher_.publish(ToMessage(stage_.tracker().DrawTracks(), frame.features.t_ns,
                                             config_.output.camera_frame));
    }
  }

  DropCounts Drops() const {
    DropCounts drops = {{"images_unreadable", unreadable_images_, first_unreadable_}};
    Append(ToDropCounts(stage_.counts()), &drops);
    return drops;
  }

  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    if (stage_.counts().images == 0) {
      status.summary(DiagnosticStatus::WARN, "no image on " + config_.sensor.image_topic + " yet");
    } else {
      status.summary(DiagnosticStatus::OK, "tracking");
    }
    status.add("images", stage_.counts().images);
    status.add("features", features_in_last_image_);
    for (const DropCount& drop : Drops()) status.add(drop.cause, drop.count);
  }

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  image_transport::ImageTransport transport_{node_};
  image_transport::ImageTransport private_transport_{private_node_};

  const Config config_;
  const TrackerNodeOptions options_;
  Stage stage_;
  DropWarner drop_warner_;
  int64_t unreadable_images_ = 0;
  std::string first_unreadable_;
  size_t features_in_last_image_ = 0;

  image_transport::Subscriber image_subscriber_;
  ros::Subscriber compressed_subscriber_;
  ros::Subscriber imu_subscriber_;
  ros::Publisher feature_publisher_;
  ros::Publisher restart_publisher_;
  image_transport::Publisher annotated_publisher_;
  ros::WallTimer flush_timer_;
  ros::WallTime last_image_arrival_;
  ros::WallTimer diagnostics_timer_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace plm_vins
