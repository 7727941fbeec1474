// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/keyframe_conversion.h"

#include <sensor_msgs/ChannelFloat32.h>

#include <limits>
#include <stdexcept>
#include <unordered_set>

#include "common/features/feature_checks.h"
#include "common/features/feature_ids.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

constexpr size_t kValuesPerChannel = 5;

geometry_msgs::Point32 Nowhere() {
  return ToPoint32(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
}

Eigen::Vector3d ToVector(const geometry_msgs::Point32& p) { return {p.x, p.y, p.z}; }

sensor_msgs::ChannelFloat32 ToChannel(const Eigen::Vector2d& first, const Eigen::Vector2d& second,
                                      int64_t id, int camera) {
  sensor_msgs::ChannelFloat32 channel;
  channel.values = {static_cast<float>(first.x()), static_cast<float>(first.y()),
                    static_cast<float>(second.x()), static_cast<float>(second.y()),
                    static_cast<float>(WrapId(id))};
  if (camera > 0) channel.values.push_back(static_cast<float>(camera));
  return channel;
}

// Returns a number that no camera has if it is not one.
int CameraIn(const sensor_msgs::ChannelFloat32& channel) {
  if (channel.values.size() == kValuesPerChannel) return 0;
  const float camera = channel.values[kValuesPerChannel];
  return camera >= 0 && camera < kMaxCameras ? static_cast<int>(camera) : -1;
}

// Validates that there is one channel for each feature, which has `points_each` points.
void CheckLayout(const sensor_msgs::PointCloud& message, size_t points_each) {
  if (message.points.size() != points_each * message.channels.size()) {
    throw std::invalid_argument(
        "keyframe message: the number of channels differs from the number of features");
  }
  for (const sensor_msgs::ChannelFloat32& channel : message.channels) {
    if (channel.values.size() < kValuesPerChannel) {
      throw std::invalid_argument("keyframe message: a channel has fewer than five values");
    }
  }
}

}  // namespace

sensor_msgs::PointCloud ToKeyframePoints(const std::vector<TrackedCorner>& corners, int64_t t_ns,
                                         const std::string& frame_id) {
  sensor_msgs::PointCloud cloud = EmptyCloud(t_ns, frame_id);
  for (const TrackedCorner& corner : corners) {
    if (!corner.p_O) continue;
    cloud.points.push_back(ToPoint32(*corner.p_O));
    const PointObservation& seen = corner.observation;
    cloud.channels.push_back(ToChannel(seen.xy, seen.uv_px, seen.id, seen.camera));
  }
  return cloud;
}

std::vector<TrackedCorner> ToCorners(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  CheckLayout(message, 1);
  std::vector<TrackedCorner> corners;
  std::unordered_set<int64_t> ids;
  for (size_t i = 0; i < message.points.size(); ++i) {
    const auto& values = message.channels[i].values;
    TrackedCorner corner;
    corner.observation.xy = {values[0], values[1]};
    corner.observation.uv_px = {values[2], values[3]};
    corner.observation.id = ReadId(values[4]);
    corner.observation.camera = CameraIn(message.channels[i]);
    corner.p_O = ToVector(message.points[i]);
    if (corner.p_O->allFinite() && IsPossibleAndNew(corner.observation, &ids)) {
      corners.push_back(corner);
    }
  }
  *left_out += static_cast<int64_t>(message.points.size() - corners.size());
  return corners;
}

sensor_msgs::PointCloud ToKeyframeLines(const std::vector<TrackedSegment>& segments, int64_t t_ns,
                                        const std::string& frame_id) {
  sensor_msgs::PointCloud cloud = EmptyCloud(t_ns, frame_id);
  for (const TrackedSegment& segment : segments) {
    const bool is_placed = segment.landmark.has_value();
    cloud.points.push_back(is_placed ? ToPoint32(segment.landmark->start_O) : Nowhere());
    cloud.points.push_back(is_placed ? ToPoint32(segment.landmark->end_O) : Nowhere());
    const LineObservation& seen = segment.observation;
    cloud.channels.push_back(ToChannel(seen.start, seen.end, seen.id, seen.camera));
  }
  return cloud;
}

std::vector<TrackedSegment> ToSegments(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  CheckLayout(message, 2);
  std::vector<TrackedSegment> segments;
  std::unordered_set<int64_t> ids;
  for (size_t i = 0; 2 * i < message.points.size(); ++i) {
    const auto& values = message.channels[i].values;
    TrackedSegment segment;
    segment.observation.start = {values[0], values[1]};
    segment.observation.end = {values[2], values[3]};
    segment.observation.id = ReadId(values[4]);
    segment.observation.camera = CameraIn(message.channels[i]);
    const SpaceSegment place{ToVector(message.points[2 * i]), ToVector(message.points[2 * i + 1])};
    if (place.start_O.allFinite() && place.end_O.allFinite()) segment.landmark = place;
    if (IsPossibleAndNew(segment.observation, &ids)) segments.push_back(segment);
  }
  *left_out += static_cast<int64_t>(message.points.size() / 2 - segments.size());
  return segments;
}

}  // namespace plm_vins
