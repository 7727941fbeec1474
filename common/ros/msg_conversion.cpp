// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/msg_conversion.h"

#include <algorithm>
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

// Channels after those of VINS-Mono and PL-VINS.
constexpr std::array<const char*, 1> kDepthChannels = {"depth"};
constexpr std::array<const char*, 3> kFurtherLineChannels = {"camera_id", "deviation",
                                                             "deviation_end"};

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

// Adds one value per observation to each channel. `values` computes them from an observation.
template <size_t kSize, typename Observation, typename Values>
void AddChannels(const std::array<const char*, kSize>& names,
                 const std::vector<Observation>& observations, const Values& values,
                 sensor_msgs::PointCloud* cloud) {
  const size_t first = cloud->channels.size();
  for (const char* name : names) AddChannel(name, observations.size(), cloud);
  for (const Observation& observation : observations) {
    const std::array<double, kSize> row = values(observation);
    for (size_t i = 0; i < kSize; ++i) {
      cloud->channels[first + i].values.push_back(static_cast<float>(row[i]));
    }
  }
}

// Returns the first of these adjacent channels. Returns nullptr if the message has none, or not one
// value for each point.
template <size_t kSize>
const sensor_msgs::ChannelFloat32* FindChannels(const sensor_msgs::PointCloud& cloud,
                                                const std::array<const char*, kSize>& names) {
  for (size_t first = 0; first + kSize <= cloud.channels.size(); ++first) {
    bool matches = true;
    for (size_t i = 0; i < kSize; ++i) {
      const sensor_msgs::ChannelFloat32& channel = cloud.channels[first + i];
      matches = matches && channel.name == names[i] && channel.values.size() == cloud.points.size();
    }
    if (matches) return &cloud.channels[first];
  }
  return nullptr;
}

// Returns the timestamp of a feature message. A message may have an invalid timestamp that ROS
// itself cannot create.
int64_t StampOf(const sensor_msgs::PointCloud& cloud) {
  const int64_t t_ns = ToNanoseconds(cloud.header.stamp);
  if (!IsStamp(t_ns)) throw std::invalid_argument("feature message has an invalid timestamp");
  return t_ns;
}

void CheckChannels(const sensor_msgs::PointCloud& cloud, size_t count, const char* expected) {
  bool valid = cloud.channels.size() >= count;
  for (size_t i = 0; valid && i < count; ++i) {
    valid = cloud.channels[i].values.size() == cloud.points.size();
  }
  if (!valid) {
    throw std::invalid_argument(std::string("feature message must have the channels ") + expected +
                                ", with one value per point");
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
  const bool has_depth = FindChannels(points, kDepthChannels) != nullptr;
  if (points.channels.size() - has_depth > 5) return {6, 2, "id, camera_id, u, v, vx, vy"};
  if (HasVelocities(points)) return {5, 1, "id, u, v, vx, vy"};
  return {3, 1, "id, u, v (, vx, vy)"};
}

// Returns -1, which is no camera, for other values.
int ReadCamera(float value) {
  return value >= 0 && value < static_cast<float>(kMaxCameras) ? static_cast<int>(value) : -1;
}

template <typename Observation>
bool HasFurtherCameras(const std::vector<Observation>& observations) {
  return std::any_of(observations.begin(), observations.end(),
                     [](const Observation& observation) { return observation.camera > 0; });
}

sensor_msgs::PointCloud WithoutCameras(const PointFrame& frame, const std::string& frame_id) {
  const std::array<const char*, 5> channels = {"id", "u", "v", "vx", "vy"};
  sensor_msgs::PointCloud cloud = FeatureCloud(frame.t_ns, frame_id, frame.points.size(), channels);
  for (const PointObservation& point : frame.points) {
    const std::array<double, 5> values = {static_cast<double>(WrapId(point.id)), point.uv_px.x(),
                                          point.uv_px.y(), point.velocity.x(), point.velocity.y()};
    Append(point.xy, values, &cloud);
  }
  return cloud;
}

sensor_msgs::PointCloud WithCameras(const PointFrame& frame, const std::string& frame_id) {
  sensor_msgs::PointCloud cloud = WithoutCameras(frame, frame_id);
  sensor_msgs::ChannelFloat32 cameras;
  cameras.name = "camera_id";
  for (const PointObservation& point : frame.points) {
    cameras.values.push_back(static_cast<float>(point.camera));
  }
  cloud.channels.insert(cloud.channels.begin() + 1, cameras);
  return cloud;
}

void AddDepth(const std::vector<PointObservation>& points, sensor_msgs::PointCloud* cloud) {
  const auto values = [](const PointObservation& point) {
    return std::array<double, 1>{point.depth.value_or(0)};
  };
  const auto has_depth = [](const PointObservation& point) { return point.depth.has_value(); };
  if (std::any_of(points.begin(), points.end(), has_depth)) {
    AddChannels(kDepthChannels, points, values, cloud);
  }
}

}  // namespace

ImuSample ToImuSample(const sensor_msgs::Imu& message) {
  const auto& w = message.angular_velocity;
  const auto& a = message.linear_acceleration;
  return {ToNanoseconds(message.header.stamp), {w.x, w.y, w.z}, {a.x, a.y, a.z}};
}

sensor_msgs::PointCloud ToMessage(const PointFrame& frame, const std::string& frame_id) {
  sensor_msgs::PointCloud cloud = HasFurtherCameras(frame.points) ? WithCameras(frame, frame_id)
                                                                  : WithoutCameras(frame, frame_id);
  AddDepth(frame.points, &cloud);
  return cloud;
}

PointFrame ToPointFrame(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  const PointLayout layout = LayoutOf(message);
  CheckChannels(message, layout.channels, layout.names);
  const auto* depth = FindChannels(message, kDepthChannels);
  PointFrame frame;
  frame.t_ns = StampOf(message);
  frame.points.resize(message.points.size());
  const auto value = [&](size_t channel, size_t i) { return message.channels[channel].values[i]; };
  for (size_t i = 0; i < message.points.size(); ++i) {
    PointObservation& point = frame.points[i];
    const size_t pixel = layout.first_pixel;
    point.id = ReadId(value(0, i));
    if (pixel == 2) point.camera = ReadCamera(value(1, i));
    point.xy = {message.points[i].x, message.points[i].y};
    point.uv_px = {value(pixel, i), value(pixel + 1, i)};
    if (HasVelocities(message)) point.velocity = {value(pixel + 2, i), value(pixel + 3, i)};
    if (depth != nullptr && depth->values[i] > 0) point.depth = depth->values[i];
  }
  *left_out += RemoveImpossible(&frame.points);
  SortByCamera(&frame.points);
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
  if (!HasFurtherCameras(frame.lines)) return cloud;
  const auto values = [](const LineObservation& line) {
    return std::array<double, 3>{static_cast<double>(line.camera), line.deviation.x(),
                                 line.deviation.y()};
  };
  AddChannels(kFurtherLineChannels, frame.lines, values, &cloud);
  return cloud;
}

LineFrame ToLineFrame(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  CheckChannels(message, 3, "id, x_end, y_end");
  LineFrame frame;
  frame.t_ns = StampOf(message);
  frame.lines.resize(message.points.size());
  const auto* further = FindChannels(message, kFurtherLineChannels);
  const auto value = [&](int channel, size_t i) { return message.channels[channel].values[i]; };
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    LineObservation& line = frame.lines[i];
    line.id = ReadId(value(0, i));
    line.start = {message.points[i].x, message.points[i].y};
    line.end = {value(1, i), value(2, i)};
    if (further == nullptr) continue;
    line.camera = ReadCamera(further[0].values[i]);
    line.deviation = {further[1].values[i], further[2].values[i]};
  }
  *left_out += RemoveImpossible(&frame.lines);
  SortByCamera(&frame.lines);
  return frame;
}

sensor_msgs::PointCloud EmptyCloud(int64_t t_ns, const std::string& frame_id) {
  sensor_msgs::PointCloud cloud;
  cloud.header = MakeHeader(t_ns, frame_id);
  return cloud;
}

}  // namespace plm_vins
