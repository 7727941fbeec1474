// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud.h>

#include <functional>
#include <optional>
#include <vector>

#include "common/config/sensor_config.h"
#include "common/streams/drop_counts.h"
#include "pose_graph/keyframes/keyframe_assembly.h"

namespace plm_vins {

// Converts odometry messages and images to keyframes. Invalid messages are dropped and counted: a
// single pose that is not finite would damage the map permanently. For use by one thread.
class KeyframeInput {
 public:
  explicit KeyframeInput(const SensorConfig& sensor);

  // Numbers of the cameras whose images are described: all but the second ones of pairs, which show
  // the same as the first ones.
  const std::vector<int>& cameras() const { return cameras_; }
  void AddImage(int camera, const ImageSample& image);
  void AddPose(const nav_msgs::Odometry& message);
  void AddPoints(const sensor_msgs::PointCloud& message);
  void AddLines(const sensor_msgs::PointCloud& message);
  // Sets a refined camera, which applies to the following keyframes.
  void AddCamera(int camera, const sensor_msgs::CameraInfo& message);
  // Sets the refined T_B_C of a camera, which applies to the following keyframes.
  void AddExtrinsics(int camera, const nav_msgs::Odometry& message);

  // Returns the next keyframe in temporal order, or nullopt if none is complete yet.
  std::optional<OdometryFrame> Pop();

  // Discards incomplete keyframes.
  void Clear() { assembly_.Clear(); }

  // Returns false, and counts the message, if position, quaternion or covariance is invalid.
  bool Accepts(const nav_msgs::Odometry& message);

  DropCounts Drops() const {
    const DropCount without_image = {"keyframes_without_image", assembly_.without_image(), ""};
    return {malformed_, poses_, features_, without_image, images_, cameras_refused_};
  }

 private:
  SensorConfig sensor_;
  KeyframeAssembly assembly_;
  std::vector<int> cameras_;
  std::vector<CameraParameters> refined_;  // by camera
  std::vector<Rigid3d> T_B_C_;             // by camera
  DropCount malformed_{"keyframe_messages_malformed", 0, ""};
  DropCount poses_{"poses_impossible", 0, ""};
  DropCount features_{"places_impossible", 0, ""};
  DropCount cameras_refused_{"cameras_refused", 0, ""};
  DropCount images_{"images_wrong_format", 0, ""};
};

}  // namespace plm_vins
