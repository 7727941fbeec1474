// SPDX-License-Identifier: BSD-3-Clause
// The line front end as a node: ~linefeature, ~linefeature_img and ~restart out. The estimator
// waits for lines for three images at most, so a tracker that cannot keep up leaves out images
// instead of falling back further.
#include <ros/spinner.h>

#include "common/ros/tracker_node.h"
#include "linefeature_tracker/line_tracking_stage.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "linefeature_tracker", [](const plm_vins::Config& config) {
    const plm_vins::TrackerNode<plm_vins::LineTrackingStage> node(
        config, {"linefeature", "linefeature_img", "line tracking", 3});
    ros::spin();
  });
}
