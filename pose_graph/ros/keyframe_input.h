// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud.h>

#include <functional>
#include <optional>

#include "common/config/sensor_config.h"
#include "common/streams/drop_counts.h"
#include "pose_graph/keyframes/keyframe_assembly.h"

namespace plm_vins {

// From the messages of odometry, and images, to keyframes. What cannot be true stays out, and is
// counted: one pose that is not finite would spoil a map for good. For one thread.
class KeyframeInput {
 public:
  explicit KeyframeInput(const SensorConfig& sensor) : sensor_(sensor) {}

  void AddImage(const ImageSample& image);
  void AddPose(const nav_msgs::Odometry& message);
  void AddPoints(const sensor_msgs::PointCloud& message);
  void AddLines(const sensor_msgs::PointCloud& message);
  // The camera as refined by now, for the keyframes that follow.
  void AddCamera(const sensor_msgs::CameraInfo& message);
  // T_B_C as estimated by now, the same way.
  void AddExtrinsics(const nav_msgs::Odometry& message);

  // The next keyframe in order of time, or nothing yet.
  std::optional<OdometryFrame> Pop();

  // Forgets what waits for other parts.
  void Clear() { assembly_.Clear(); }

  // False, and counted, where the position, the quaternion or the covariance cannot be true.
  bool Accepts(const nav_msgs::Odometry& message);

  DropCounts Drops() const {
    const DropCount without_image = {"keyframes_without_image", assembly_.without_image(), ""};
    return {malformed_, poses_, features_, without_image, images_, cameras_};
  }

 private:
  SensorConfig sensor_;
  KeyframeAssembly assembly_;
  std::optional<CameraParameters> camera_;
  Rigid3d T_B_C_ = sensor_.T_B_C;
  DropCount malformed_{"keyframe_messages_malformed", 0, ""};
  DropCount poses_{"poses_impossible", 0, ""};
  DropCount features_{"places_impossible", 0, ""};
  DropCount cameras_{"cameras_refused", 0, ""};
  DropCount images_{"images_wrong_format", 0, ""};
};

}  // namespace plm_vins
