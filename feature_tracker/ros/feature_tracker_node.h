// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <string>

#include "common/config.h"
#include "common/ros/node_setup.h"
#include "feature_tracker/point_tracking_stage.h"

namespace plm_vins {

// The point front end as a node: images (and the IMU, where it comes) in; ~feature, ~feature_img
// and ~restart out. One thread: images queue in their subscriber while one is tracked, none is
// dropped as long as tracking keeps up on average.
//
// ~image_transport: raw (default), compressed (decoded here, no plugin needed) or any plugin's
// name.
class FeatureTrackerNode {
 public:
  explicit FeatureTrackerNode(const Config& config);

 private:
  void Subscribe();
  void AddImu(const sensor_msgs::Imu& message);
  template <typename Image>
  void AddImage(const Image& message);
  void FlushLateImages();
  void Publish(const TrackedPoints& frame);
  void PublishTrackImage(int64_t t_ns);
  void ReportStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  image_transport::ImageTransport transport_{node_};
  image_transport::ImageTransport private_transport_{private_node_};

  Config config_;
  PointTrackingStage stage_;
  DropWarner drop_warner_;
  int64_t unreadable_images_ = 0;
  std::string first_unreadable_;
  size_t points_in_last_frame_ = 0;

  image_transport::Subscriber image_subscriber_;
  ros::Subscriber compressed_subscriber_;
  ros::Subscriber imu_subscriber_;
  ros::Publisher feature_publisher_;
  ros::Publisher restart_publisher_;
  image_transport::Publisher track_image_publisher_;
  ros::WallTimer flush_timer_;
  ros::WallTime last_image_arrival_;
  ros::WallTimer diagnostics_timer_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace plm_vins
