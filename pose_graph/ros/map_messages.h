// SPDX-License-Identifier: BSD-3-Clause
// What the pose graph says, as messages.
#pragma once

#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "pose_graph/loop_closer.h"

namespace plm_vins {

// Odometry's message in the map: its pose moved, with its covariance there; one that is not known
// stays so. The twist stays, too, as it is in the body's frame.
nav_msgs::Odometry ToMap(const nav_msgs::Odometry& odometry, const MapFix& fix,
                         const std::string& map_frame);

// The keyframes that are connected with the newest, where they are as known now: in the map, or in
// the odometry's world where that has no place in the map yet. At most the newest 5000.
nav_msgs::Path ToPath(const KeyframeMap& map, const std::string& map_frame,
                      const std::string& world_frame);

// Two lists of lines in the map: odometry's edges in grey, loops in green, with the stamp of the
// newest keyframe. One that is empty is deleted, since rviz takes it for an error.
visualization_msgs::MarkerArray ToGraphMarkers(const KeyframeMap& map,
                                               const std::string& map_frame);

}  // namespace plm_vins
