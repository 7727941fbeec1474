// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/msg_conversion.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/features/feature_checks.h"
#include "common/features/feature_ids.h"
#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

void AddChannel(const std::string& name, size_t size, sensor_msgs::PointCloud* cloud) {
  cloud->channels.emplace_back();
  cloud->channels.back().name = name;
  cloud->channels.back().values.reserve(size);
}

template <size_t kSize>
sensor_msgs::PointCloud FeatureCloud(int64_t t_ns, const std::string& frame_id, size_t size,
                                     const std::array<const char*, kSize>& channels) {
  sensor_msgs::PointCloud cloud = EmptyCloud(t_ns, frame_id);
  cloud.points.reserve(size);
  for (const char* name : channels) AddChannel(name, size, &cloud);
  return cloud;
}

template <size_t kSize>
void Append(const Eigen::Vector2d& xy, const std::array<double, kSize>& values,
            sensor_msgs::PointCloud* cloud) {
  cloud->points.push_back(ToPoint32(xy.homogeneous()));
  for (size_t i = 0; i < kSize; ++i) {
    cloud->channels[i].values.push_back(static_cast<float>(values[i]));
  }
}

// Returns the timestamp of a feature message. A message may have an invalid timestamp that ROS
// itself cannot create.
int64_t StampOf(const sensor_msgs::PointCloud& cloud) {
  const int64_t t_ns = ToNanoseconds(cloud.header.stamp);
  if (!IsStamp(t_ns)) throw std::invalid_argument("feature message with a stamp that is none");
  return t_ns;
}

void CheckChannels(const sensor_msgs::PointCloud& cloud, size_t count, const char* expected) {
  bool valid = cloud.channels.size() >= count;
  for (size_t i = 0; valid && i < count; ++i) {
    valid = cloud.channels[i].values.size() == cloud.points.size();
  }
  if (!valid) {
    throw std::invalid_argument(std::string("feature message without the channels ") + expected);
  }
}

// Channel layout of point messages, by the number of channels: VINS-Fusion has a camera id after
// the feature id.
struct PointLayout {
  size_t channels = 0;  // required number
  size_t first_pixel = 0;
  const char* names = "";
};

PointLayout LayoutOf(const sensor_msgs::PointCloud& points) {
  if (points.channels.size() > 5) return {6, 2, "id, camera_id, u, v, vx, vy"};
  if (HasVelocities(points)) return {5, 1, "id, u, v, vx, vy"};
  return {3, 1, "id, u, v (, vx, vy)"};
}

}  // namespace

ImuSample ToImuSample(const sensor_msgs::Imu& message) {
  const auto& w = message.angular_velocity;
  const auto& a = message.linear_acceleration;
  return {ToNanoseconds(message.header.stamp), {w.x, w.y, w.z}, {a.x, a.y, a.z}};
}

sensor_msgs::PointCloud ToMessage(const PointFrame& frame, const std::string& frame_id) {
  const std::array<const char*, 5> channels = {"id", "u", "v", "vx", "vy"};
  sensor_msgs::PointCloud cloud = FeatureCloud(frame.t_ns, frame_id, frame.points.size(), channels);
  for (const PointObservation& point : frame.points) {
    const std::array<double, 5> values = {static_cast<double>(WrapId(point.id)), point.uv_px.x(),
                                          point.uv_px.y(), point.velocity.x(), point.velocity.y()};
    Append(point.xy, values, &cloud);
  }
  return cloud;
}

PointFrame ToPointFrame(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  const PointLayout layout = LayoutOf(message);
  CheckChannels(message, layout.channels, layout.names);
  const bool has_cameras = layout.channels == 6;
  const bool has_velocities = HasVelocities(message);
  PointFrame frame;
  frame.t_ns = StampOf(message);
  frame.points.reserve(message.points.size());
  const auto value = [&](size_t channel, size_t i) { return message.channels[channel].values[i]; };
  for (size_t i = 0; i < message.points.size(); ++i) {
    if (has_cameras && value(1, i) != 0) continue;
    PointObservation& point = frame.points.emplace_back();
    const size_t pixel = layout.first_pixel;
    point.id = ReadId(value(0, i));
    point.xy = {message.points[i].x, message.points[i].y};
    point.uv_px = {value(pixel, i), value(pixel + 1, i)};
    if (has_velocities) point.velocity = {value(pixel + 2, i), value(pixel + 3, i)};
  }
  *left_out += RemoveImpossible(&frame.points);
  return frame;
}

sensor_msgs::PointCloud ToMessage(const LineFrame& frame, const std::string& frame_id) {
  const std::array<const char*, 3> channels = {"id", "x_end", "y_end"};
  sensor_msgs::PointCloud cloud = FeatureCloud(frame.t_ns, frame_id, frame.lines.size(), channels);
  for (const LineObservation& line : frame.lines) {
    const std::array<double, 3> values = {static_cast<double>(WrapId(line.id)), line.end.x(),
                                          line.end.y()};
    Append(line.start, values, &cloud);
  }
  return cloud;
}

LineFrame ToLineFrame(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  CheckChannels(message, 3, "id, x_end, y_end");
  LineFrame frame;
  frame.t_ns = StampOf(message);
  frame.lines.resize(message.points.size());
  const auto value = [&](int channel, size_t i) { return message.channels[channel].values[i]; };
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    frame.lines[i].id = ReadId(value(0, i));
    frame.lines[i].start = {message.points[i].x, message.points[i].y};
    frame.lines[i].end = {value(1, i), value(2, i)};
  }
  *left_out += RemoveImpossible(&frame.lines);
  return frame;
}

sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, const std::string& frame_id) {
  sensor_msgs::PointCloud cloud;
  cloud.header = MakeHeader(t_ns, frame_id);
  return cloud;
}

}  // namespace plm_vins
