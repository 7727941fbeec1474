// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/line_markers.h"

#include <std_msgs/ColorRGBA.h>

#include "common/ros/geometry_conversion.h"
#include "common/ros/marker.h"

namespace plm_vins {
namespace {

constexpr double kWidth = 0.02;          // [m]
constexpr double kHistoryWidth = 0.007;  // [m]: thinner than lines in use
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
  return MakeMarker(MakeHeader(t_ns, frame_id), name, visualization_msgs::Marker::LINE_LIST,
                    kWidth);
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
  if (lines.empty()) marker.action = visualization_msgs::Marker::DELETE;
  return marker;
}

// Moves the last line of the part to the removed line's place.
void LineHistory::Remove(const std::vector<int64_t>& ids) {
  for (const int64_t id : ids) {
    const auto known = places_.find(id);
    if (known == places_.end()) continue;
    const Place place = known->second;
    std::vector<MapLine>& part = parts_[place.part];
    places_[part.back().id] = place;
    part[place.line] = part.back();
    part.pop_back();
    places_.erase(id);
    changed_.insert(place.part);
  }
}

std::vector<visualization_msgs::Marker> LineHistory::Add(const std::vector<MapLine>& lines,
                                                         int64_t t_ns) {
  t_ns_ = t_ns;
  for (const MapLine& line : lines) {
    const Place place = PlaceOf(line.id);
    parts_[place.part][place.line] = line;
    changed_.insert(place.part);
  }
  std::vector<visualization_msgs::Marker> markers;
  markers.reserve(changed_.size());
  for (const size_t part : changed_) markers.push_back(MakeMarker(part));
  changed_.clear();
  return markers;
}

std::vector<visualization_msgs::Marker> LineHistory::All() const {
  std::vector<visualization_msgs::Marker> markers;
  for (size_t part = 0; part < parts_.size(); ++part) {
    if (!parts_[part].empty()) markers.push_back(MakeMarker(part));
  }
  return markers;
}

visualization_msgs::Marker LineHistory::Clear() {
  for (auto& part : parts_) part.clear();
  newest_part_ = 0;
  places_.clear();
  changed_.clear();
  visualization_msgs::Marker marker = EmptyMarker(0, frame_id_, kHistoryName);
  marker.action = visualization_msgs::Marker::DELETEALL;
  return marker;
}

// Returns the place of the line, or a new place.
LineHistory::Place LineHistory::PlaceOf(int64_t id) {
  const auto known = places_.find(id);
  if (known != places_.end()) return known->second;
  if (parts_[newest_part_].size() == kLinesPerMarker) StartNextPart();
  std::vector<MapLine>& newest = parts_[newest_part_];
  newest.emplace_back();
  return places_[id] = {newest_part_, newest.size() - 1};
}

void LineHistory::StartNextPart() {
  newest_part_ = (newest_part_ + 1) % kMaxMarkers;
  for (const MapLine& line : parts_[newest_part_]) places_.erase(line.id);
  parts_[newest_part_].clear();
}

visualization_msgs::Marker LineHistory::MakeMarker(size_t part) const {
  visualization_msgs::Marker marker = ToLineMarker(parts_[part], t_ns_, frame_id_, kHistoryName);
  marker.id = static_cast<int>(part);
  marker.scale.x = kHistoryWidth;
  return marker;
}

}  // namespace plm_vins
