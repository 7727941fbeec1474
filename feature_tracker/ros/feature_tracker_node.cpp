// SPDX-License-Identifier: BSD-3-Clause
// The point front end as a node: ~feature, ~feature_img and ~restart out. No image is dropped as
// long as tracking keeps up on average.
#include <ros/spinner.h>

#include "common/ros/tracker_node.h"
#include "feature_tracker/point_tracking_stage.h"

int main(int argc, char** argv) {
  return plm_vins::RunNode(argc, argv, "feature_tracker", [](const plm_vins::Config& config) {
    const plm_vins::TrackerNode<plm_vins::PointTrackingStage> node(
        config, {"feature", "feature_img", "point tracking", 200});
    ros::spin();
  });
}
