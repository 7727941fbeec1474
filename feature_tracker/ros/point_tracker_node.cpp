// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/ros/point_tracker_node.h"

#include <string>

#include "feature_tracker/point_tracking_stage.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {
namespace {

std::string ImageFinding(const PointTracker& tracker) {
  const std::string still_parts = tracker.StillPartsFinding();
  return still_parts.empty() ? tracker.PairFinding() : still_parts;
}

}  // namespace

std::shared_ptr<void> MakePointTrackerNode(const Config& config, const ros::NodeHandle& node,
                                           const ros::NodeHandle& private_node) {
  TrackerTraits<PointTracker> traits;
  traits.feature_topic = "feature";
  traits.annotated_topic = "feature_img";
  traits.status = "point tracking";
  traits.every_image = false;
  traits.uses_depth = true;
  traits.finding = &ImageFinding;
  return std::make_shared<TrackerNode<PointTrackingStage>>(config, node, private_node, traits);
}

}  // namespace plm_vins
