// SPDX-License-Identifier: BSD-3-Clause
// Loop closure as a node.

#include "common/ros/node_setup.h"
#include "pose_graph/ros/pose_graph_node.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "pose_graph", [](const plm_vins::Config& config) {
    const plm_vins::PoseGraphNode node(config, ros::NodeHandle(), ros::NodeHandle("~"));
    plm_vins::Spin();
  });
}
