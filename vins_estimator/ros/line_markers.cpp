// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/line_markers.h"

#include <std_msgs/ColorRGBA.h>

#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

constexpr double kWidth = 0.02;          // [m]
constexpr double kHistoryWidth = 0.007;  // [m]: lines in use stand out
constexpr char kHistoryName[] = "history_lines";

std_msgs::ColorRGBA MakeColor(float r, float g, float b) {
  std_msgs::ColorRGBA color;
  color.r = r;
  color.g = g;
  color.b = b;
  color.a = 1.0f;
  return color;
}

std_msgs::ColorRGBA ColorOf(LineAxis axis) {
  switch (axis) {
    case LineAxis::kX:
      return MakeColor(1.0f, 0.3f, 0.3f);
    case LineAxis::kY:
      return MakeColor(0.3f, 0.9f, 0.3f);
    case LineAxis::kZ:
      return MakeColor(0.4f, 0.55f, 1.0f);
    default:
      return MakeColor(0.75f, 0.75f, 0.75f);
  }
}

visualization_msgs::Marker EmptyMarker(int64_t t_ns, const std::string& frame_id,
                                       const std::string& name) {
  visualization_msgs::Marker marker;
  marker.header.stamp = ToRosTime(t_ns);
  marker.header.frame_id = frame_id;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = kWidth;
  return marker;
}

}  // namespace

visualization_msgs::Marker ToLineMarker(const std::vector<MapLine>& lines, int64_t t_ns,
                                        const std::string& frame_id, const std::string& name) {
  visualization_msgs::Marker marker = EmptyMarker(t_ns, frame_id, name);
  for (const MapLine& line : lines) {
    for (const Eigen::Vector3d& end : {line.start_W, line.end_W}) {
      marker.points.push_back(ToPoint(end));
      marker.colors.push_back(ColorOf(line.axis));
    }
  }
  return marker;
}

std::vector<visualization_msgs::Marker> LineHistory::Add(const std::vector<MapLine>& lines,
                                                         int64_t t_ns) {
  std::vector<visualization_msgs::Marker> changed;
  for (const MapLine& line : lines) {
    if (lines_.size() == kLinesPerMarker) {
      changed.push_back(MakeMarker(t_ns));
      lines_.clear();
      marker_id_ = (marker_id_ + 1) % kMaxMarkers;
    }
    lines_.push_back(line);
  }
  if (!lines.empty()) changed.push_back(MakeMarker(t_ns));
  return changed;
}

visualization_msgs::Marker LineHistory::Clear() {
  lines_.clear();
  marker_id_ = 0;
  visualization_msgs::Marker marker = EmptyMarker(0, frame_id_, kHistoryName);
  marker.action = visualization_msgs::Marker::DELETEALL;
  return marker;
}

visualization_msgs::Marker LineHistory::MakeMarker(int64_t t_ns) const {
  visualization_msgs::Marker marker = ToLineMarker(lines_, t_ns, frame_id_, kHistoryName);
  marker.id = marker_id_;
  marker.scale.x = kHistoryWidth;
  return marker;
}

}  // namespace plm_vins
