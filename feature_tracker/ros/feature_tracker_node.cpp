// SPDX-License-Identifier: BSD-3-Clause
// The point front end as a node. Publishes ~feature, ~feature_img and ~restart.

#include "common/ros/node_setup.h"
#include "feature_tracker/ros/point_tracker_node.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "feature_tracker", [](const plm_vins::Config& config) {
    const auto node =
        plm_vins::MakePointTrackerNode(config, ros::NodeHandle(), ros::NodeHandle("~"));
    plm_vins::Spin();
  });
}
