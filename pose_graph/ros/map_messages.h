// SPDX-License-Identifier: BSD-3-Clause
// Messages of the pose graph.
#pragma once

#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "pose_graph/loop_closer.h"

namespace plm_vins {

// Transforms odometry's message to the map frame: pose and covariance; an unknown covariance stays
// unknown. The twist is unchanged, since it is expressed in the body frame.
nav_msgs::Odometry ToMap(const nav_msgs::Odometry& odometry, const MapFix& fix,
                         const std::string& map_frame);

// Path of the keyframes connected with the newest one, in the map frame, or in the odometry's world
// if it is not connected with the map yet. At most the newest 5000 poses.
nav_msgs::Path ToPath(const KeyframeMap& map, const std::string& map_frame,
                      const std::string& world_frame);

// Two line lists in the map frame: odometry edges (gray) and loops (green), with the timestamp of
// the newest keyframe. An empty list becomes a deletion, since rviz reports it as an error.
visualization_msgs::MarkerArray ToGraphMarkers(const KeyframeMap& map,
                                               const std::string& map_frame);

}  // namespace plm_vins
