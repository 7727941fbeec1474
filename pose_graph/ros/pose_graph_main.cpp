// SPDX-License-Identifier: BSD-3-Clause
// The loop closure node. It exits at once if loop closure is disabled in the configuration.

#include "common/ros/node_setup.h"
#include "pose_graph/ros/pose_graph_node.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "pose_graph", [](const plm_vins::Config& config) {
    const auto node = plm_vins::MakePoseGraphNode(config, ros::NodeHandle(), ros::NodeHandle("~"));
    if (node) plm_vins::Spin();
  });
}
