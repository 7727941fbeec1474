// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/ros/feature_tracker_node.h"

#include <cv_bridge/cv_bridge.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/image_encodings.h>
#include <std_msgs/Bool.h>

#include <stdexcept>

#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

constexpr int kImageQueue = 200;
constexpr int kImuQueue = 2000;
constexpr double kMaxWaitForImu =
    0.1;  // [s] of wall time: then an image is tracked without the gyro

}  // namespace

FeatureTrackerNode::FeatureTrackerNode(const Config& config) : config_(config), stage_(config) {
  feature_publisher_ = private_node_.advertise<sensor_msgs::PointCloud>("feature", kImageQueue);
  restart_publisher_ = private_node_.advertise<std_msgs::Bool>("restart", 10);
  track_image_publisher_ = private_transport_.advertise("feature_img", 10);
  flush_timer_ = node_.createWallTimer(ros::WallDuration(0.5 * kMaxWaitForImu),
                                       [this](const ros::WallTimerEvent&) { FlushLateImages(); });
  diagnostics_.setHardwareID("none");
  diagnostics_.add("point tracking", this, &FeatureTrackerNode::ReportStatus);
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  Subscribe();
}

void FeatureTrackerNode::Subscribe() {
  const std::string topic = config_.sensor.image_topic;
  const auto transport = private_node_.param<std::string>("image_transport", "raw");
  if (transport == "compressed") {
    compressed_subscriber_ =
        node_.subscribe(topic + "/compressed", kImageQueue,
                        &FeatureTrackerNode::AddImage<sensor_msgs::CompressedImage>, this);
  } else {
    image_subscriber_ = transport_.subscribe(
        topic, kImageQueue,
        [this](const sensor_msgs::ImageConstPtr& message) { AddImage(*message); }, nullptr,
        image_transport::TransportHints(transport));
  }
  imu_subscriber_ =
      node_.subscribe(config_.sensor.imu_topic, kImuQueue, &FeatureTrackerNode::AddImu, this,
                      ros::TransportHints().tcpNoDelay());
}

void FeatureTrackerNode::AddImu(const sensor_msgs::Imu& message) {
  stage_.AddImu(ToImuSample(message));
  while (const auto frame = stage_.Pop()) Publish(*frame);
}

template <typename Image>
void FeatureTrackerNode::AddImage(const Image& message) {
  last_image_arrival_ = ros::WallTime::now();
  try {
    stage_.AddImage(ToImageSample(message));
  } catch (const std::invalid_argument& error) {
    if (unreadable_images_++ == 0) first_unreadable_ = error.what();
  }
  while (const auto frame = stage_.Pop()) Publish(*frame);
  drop_warner_.Check({{"images_unreadable", unreadable_images_, first_unreadable_}});
  drop_warner_.Check(ToDropCounts(stage_.counts()));
}

void FeatureTrackerNode::FlushLateImages() {
  if (ros::WallTime::now() - last_image_arrival_ < ros::WallDuration(kMaxWaitForImu)) return;
  while (const auto frame = stage_.Flush()) Publish(*frame);
}

void FeatureTrackerNode::Publish(const TrackedPoints& frame) {
  if (frame.restart) {
    std_msgs::Bool restart;
    restart.data = true;
    restart_publisher_.publish(restart);
  }
  points_in_last_frame_ = frame.features.points.size();
  if (!frame.publish) return;
  feature_publisher_.publish(ToMessage(frame.features, config_.output.camera_frame));
  if (config_.show_track && track_image_publisher_.getNumSubscribers() > 0) {
    PublishTrackImage(frame.features.t_ns);
  }
}

void FeatureTrackerNode::PublishTrackImage(int64_t t_ns) {
  cv_bridge::CvImage image;
  image.header.stamp = ToRosTime(t_ns);
  image.header.frame_id = config_.output.camera_frame;
  image.encoding = sensor_msgs::image_encodings::BGR8;
  image.image = stage_.tracker().DrawTracks();
  track_image_publisher_.publish(image.toImageMsg());
}

void FeatureTrackerNode::ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (stage_.counts().images == 0) {
    status.summary(DiagnosticStatus::WARN, "no image on " + config_.sensor.image_topic + " yet");
  } else {
    status.summary(DiagnosticStatus::OK, "tracking");
  }
  status.add("images", stage_.counts().images);
  status.add("points", points_in_last_frame_);
  status.add("images_unreadable", unreadable_images_);
  for (const DropCount& drop : ToDropCounts(stage_.counts())) status.add(drop.cause, drop.count);
}

}  // namespace plm_vins

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "feature_tracker", [](const plm_vins::Config& config) {
    const plm_vins::FeatureTrackerNode node(config);
    ros::spin();
  });
}
