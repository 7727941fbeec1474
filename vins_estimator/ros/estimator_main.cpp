// SPDX-License-Identifier: BSD-3-Clause
// Runs the back end as a ROS node.

#include "common/ros/node_setup.h"
#include "vins_estimator/ros/estimator_node.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "vins_estimator", [](const plm_vins::Config& config) {
    plm_vins::EstimatorNode node(config, ros::NodeHandle(), ros::NodeHandle("~"));
    plm_vins::Spin();
    node.Finish();
  });
}
