// SPDX-License-Identifier: BSD-3-Clause
// The line front end as a node: ~linefeature, ~linefeature_img and ~restart out. Where the
// configuration does without lines it stays idle: launch files start it again if it ends.

#include "linefeature_tracker/ros/line_node_traits.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "linefeature_tracker", [](const plm_vins::Config& config) {
    const plm_vins::LineTrackerNode node(config, ros::NodeHandle(), ros::NodeHandle("~"));
    plm_vins::Spin();
  });
}
