// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/msg_conversion.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <unordered_map>
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

// Channels for observations by further sensors, after the channels of the VINS family.
constexpr std::array<const char*, 3> kRightPointChannels = {"right_search", "right_x", "right_y"};
constexpr std::array<const char*, 1> kDepthChannels = {"depth"};
constexpr std::array<const char*, 6> kRightLineChannels = {
    "right_x", "right_y", "right_x_end", "right_y_end", "right_deviation", "right_deviation_end"};

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
  const bool is_ours = FindChannels(points, kRightPointChannels) != nullptr ||
                       FindChannels(points, kDepthChannels) != nullptr;
  if (points.channels.size() > 5 && !is_ours) return {6, 2, "id, camera_id, u, v, vx, vy"};
  if (HasVelocities(points)) return {5, 1, "id, u, v, vx, vy"};
  return {3, 1, "id, u, v (, vx, vy)"};
}

void AddRight(const std::vector<PointObservation>& points, sensor_msgs::PointCloud* cloud) {
  const auto values = [](const PointObservation& point) {
    const Eigen::Vector2d right = point.right.value_or(Eigen::Vector2d::Zero());
    return std::array<double, 3>{static_cast<double>(point.right_search), right.x(), right.y()};
  };
  const auto is_due = [](const PointObservation& point) {
    return point.right_search != RightSearch::kNotDue;
  };
  if (std::any_of(points.begin(), points.end(), is_due)) {
    AddChannels(kRightPointChannels, points, values, cloud);
  }
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

void AddRight(const std::vector<LineObservation>& lines, sensor_msgs::PointCloud* cloud) {
  const auto values = [](const LineObservation& line) {
    const auto [start, end, deviation] = line.right.value_or(RightSegment());
    return std::array<double, 6>{start.x(), start.y(),     end.x(),
                                 end.y(),   deviation.x(), deviation.y()};
  };
  const auto has_right = [](const LineObservation& line) { return line.right.has_value(); };
  if (std::any_of(lines.begin(), lines.end(), has_right)) {
    AddChannels(kRightLineChannels, lines, values, cloud);
  }
}

// Reads the channels of further sensors for the i-th point of a message.
void ReadCompanions(const sensor_msgs::PointCloud& message, size_t i, PointObservation* point) {
  if (const auto* right = FindChannels(message, kRightPointChannels)) {
    const float search = right[0].values[i];
    if (!(search >= 0 && search <= static_cast<float>(RightSearch::kFound))) return;
    point->right_search = static_cast<RightSearch>(search);
    if (point->right_search == RightSearch::kFound) {
      point->right = Eigen::Vector2d(right[1].values[i], right[2].values[i]);
    }
  }
  const auto* depth = FindChannels(message, kDepthChannels);
  if (depth != nullptr && depth->values[i] > 0) point->depth = depth->values[i];
}

// Adds VINS-Fusion's points of the second camera to those of the first one with the same id.
void AddSecondCamera(const sensor_msgs::PointCloud& message,
                     std::vector<PointObservation>* points) {
  std::unordered_map<int64_t, PointObservation*> by_id;
  for (PointObservation& point : *points) by_id[point.id] = &point;
  for (size_t i = 0; i < message.points.size(); ++i) {
    if (message.channels[1].values[i] != 1) continue;
    const auto found = by_id.find(ReadId(message.channels[0].values[i]));
    if (found == by_id.end()) continue;
    found->second->right = Eigen::Vector2d(message.points[i].x, message.points[i].y);
    found->second->right_search = RightSearch::kFound;
  }
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
  AddRight(frame.points, &cloud);
  AddDepth(frame.points, &cloud);
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
    ReadCompanions(message, i, &point);
  }
  if (has_cameras) AddSecondCamera(message, &frame.points);
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
  AddRight(frame.lines, &cloud);
  return cloud;
}

LineFrame ToLineFrame(const sensor_msgs::PointCloud& message, int64_t* left_out) {
  CheckChannels(message, 3, "id, x_end, y_end");
  LineFrame frame;
  frame.t_ns = StampOf(message);
  frame.lines.resize(message.points.size());
  const auto* right = FindChannels(message, kRightLineChannels);
  const auto value = [&](int channel, size_t i) { return message.channels[channel].values[i]; };
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    frame.lines[i].id = ReadId(value(0, i));
    frame.lines[i].start = {message.points[i].x, message.points[i].y};
    frame.lines[i].end = {value(1, i), value(2, i)};
    if (right == nullptr || !(right[4].values[i] > 0)) continue;
    const auto pair = [&](size_t k) {
      return Eigen::Vector2d(right[k].values[i], right[k + 1].values[i]);
    };
    frame.lines[i].right = RightSegment{pair(0), pair(2), pair(4)};
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
