// SPDX-License-Identifier: BSD-3-Clause
// The line front end as a node. Publishes ~linefeature, ~linefeature_img and ~restart. It is idle,
// instead of exiting, if the configuration disables lines, since launch files restart nodes that
// exit.

#include "common/ros/node_setup.h"
#include "linefeature_tracker/ros/line_tracker_node.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "linefeature_tracker", [](const plm_vins::Config& config) {
    const auto node =
        plm_vins::MakeLineTrackerNode(config, ros::NodeHandle(), ros::NodeHandle("~"));
    plm_vins::Spin();
  });
}
