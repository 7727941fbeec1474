// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/map_messages.h"

#include <geometry_msgs/PoseStamped.h>

#include <algorithm>

#include "common/ros/geometry_conversion.h"
#include "common/ros/marker.h"

namespace plm_vins {
namespace {

constexpr int kMaxPathPoses = 5000;  // the newest; each keyframe sends the whole message
constexpr double kStepWidth = 0.01;  // [m]
constexpr double kLoopWidth = 0.02;  // [m]

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
    pose.header = MakeHeader(map.keyframes[i].t_ns, path.header.frame_id);
    pose.pose = ToPose(map.T_M_O(i).ToRigid() * map.keyframes[i].T_O_B);
  }
  if (!path.poses.empty()) path.header.stamp = path.poses.back().header.stamp;
  return path;
}

visualization_msgs::MarkerArray ToGraphMarkers(const KeyframeMap& map,
                                               const std::string& map_frame) {
  constexpr int kType = visualization_msgs::Marker::LINE_LIST;
  const auto header = MakeHeader(map.keyframes.empty() ? 0 : map.keyframes.back().t_ns, map_frame);
  visualization_msgs::Marker steps = MakeMarker(header, "odometry", kType, kStepWidth);
  steps.color.r = steps.color.g = steps.color.b = 0.6F;
  visualization_msgs::Marker loops = MakeMarker(header, "loops", kType, kLoopWidth);
  loops.color.g = 1;
  const std::vector<bool> is_in_map = map.graph.ConnectedWith(0);
  for (const LevelEdge& edge : map.graph.edges()) {
    if (!is_in_map[edge.from]) continue;
    visualization_msgs::Marker& list = edge.is_loop ? loops : steps;
    list.points.push_back(ToPoint(map.graph.node(edge.from).translation));
    list.points.push_back(ToPoint(map.graph.node(edge.to).translation));
  }
  visualization_msgs::MarkerArray markers;
  markers.markers = {steps, loops};
  for (visualization_msgs::Marker& marker : markers.markers) {
    if (marker.points.empty()) marker.action = visualization_msgs::Marker::DELETE;
  }
  return markers;
}

}  // namespace plm_vins
