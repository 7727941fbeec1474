// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/ros/line_tracker_node.h"

#include "linefeature_tracker/line_tracking_stage.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {

std::shared_ptr<void> MakeLineTrackerNode(const Config& config, const ros::NodeHandle& node,
                                          const ros::NodeHandle& private_node) {
  if (!IsNeeded(config.use_lines, "use_lines", config)) return nullptr;
  TrackerTraits<LineTracker> traits;
  traits.feature_topic = "linefeature";
  traits.annotated_topic = "linefeature_img";
  traits.status = "line tracking";
  // The point tracker, possibly another program, decides which images are used.
  traits.every_image = true;
  traits.uses_depth = false;
  // The point tracker judges the pairs of cameras.
  traits.finding = [](const LineTracker&) { return ""; };
  return std::make_shared<TrackerNode<LineTrackingStage>>(config, node, private_node, traits);
}

}  // namespace plm_vins
