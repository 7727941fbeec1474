// SPDX-License-Identifier: BSD-3-Clause
// Loop closure as the nodelet plm_vins/PoseGraph. It is idle if loop closure is disabled in the
// configuration.
#include <pluginlib/class_list_macros.hpp>

#include "common/ros/nodelet_of.h"
#include "pose_graph/ros/pose_graph_node.h"

namespace plm_vins {
using PoseGraphNodelet = NodeletOf<&MakePoseGraphNode>;
}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::PoseGraphNodelet, nodelet::Nodelet)
