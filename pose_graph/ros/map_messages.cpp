// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/map_messages.h"

#include <geometry_msgs/PoseStamped.h>

#include <algorithm>

#include "common/ros/msg_conversion.h"

namespace plm_vins {
namespace {

constexpr int kMaxPathPoses = 5000;  // the newest; the message is sent anew with each keyframe

visualization_msgs::Marker LineList(const std::string& name, double width) {
  visualization_msgs::Marker marker;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.scale.x = width;
  marker.color.a = 1;
  return marker;
}

}  // namespace

nav_msgs::Odometry ToMap(const nav_msgs::Odometry& odometry, const MapFix& fix,
                         const std::string& map_frame) {
  nav_msgs::Odometry result = odometry;
  result.header.frame_id = map_frame;
  const Rigid3d T_O_B = ToRigid(odometry.pose.pose);
  result.pose.pose = ToPose(fix.T_M_O.ToRigid() * T_O_B);
  if (const auto covariance = CovarianceOf(odometry.pose)) {
    SetCovariance(CovarianceInMap(fix, T_O_B, *covariance), &result.pose);
  }
  return result;
}

nav_msgs::Path ToPath(const KeyframeMap& map, const std::string& map_frame,
                      const std::string& world_frame) {
  nav_msgs::Path path;
  const int newest = map.graph.size() - 1;
  const std::vector<bool> connected = map.graph.ConnectedWith(newest);
  const bool is_in_map = connected.empty() || connected[0];
  path.header.frame_id = is_in_map ? map_frame : world_frame;
  for (int i = std::max(0, newest + 1 - kMaxPathPoses); i <= newest; ++i) {
    if (!connected[i]) continue;
    geometry_msgs::PoseStamped& pose = path.poses.emplace_back();
    pose.header.frame_id = path.header.frame_id;
    pose.header.stamp = ToRosTime(map.keyframes[i].t_ns);
    pose.pose = ToPose(map.T_M_O(i).ToRigid() * map.keyframes[i].T_O_B);
  }
  if (!path.poses.empty()) path.header.stamp = path.poses.back().header.stamp;
  return path;
}

visualization_msgs::MarkerArray ToGraphMarkers(const KeyframeMap& map,
                                               const std::string& map_frame) {
  visualization_msgs::Marker steps = LineList("odometry", 0.01);
  steps.color.r = steps.color.g = steps.color.b = 0.6F;
  visualization_msgs::Marker loops = LineList("loops", 0.02);
  loops.color.g = 1;
  const std::vector<bool> is_in_map = map.graph.ConnectedWith(0);
  for (const LevelEdge& edge : map.graph.edges()) {
    if (!is_in_map[edge.from]) continue;
    visualization_msgs::Marker& list = edge.is_loop ? loops : steps;
    list.points.push_back(ToPoint(map.graph.node(edge.from).translation));
    list.points.push_back(ToPoint(map.graph.node(edge.to).translation));
  }
  const int64_t t_ns = map.keyframes.empty() ? 0 : map.keyframes.back().t_ns;
  visualization_msgs::MarkerArray markers;
  markers.markers = {steps, loops};
  for (visualization_msgs::Marker& marker : markers.markers) {
    marker.header.frame_id = map_frame;
    marker.header.stamp = ToRosTime(t_ns);
    if (marker.points.empty()) marker.action = visualization_msgs::Marker::DELETE;
  }
  return markers;
}

}  // namespace plm_vins
