// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/ros/point_tracker_node.h"

#include <string>

#include "feature_tracker/point_tracking_stage.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {
namespace {

// Traits of the point tracker for TrackerNode.
struct PointNodeTraits {
  using Stage = PointTrackingStage;

  static constexpr char kFeatureTopic[] = "feature";
  static constexpr char kAnnotatedTopic[] = "feature_img";
  static constexpr char kDiagnostics[] = "point tracking";
  static constexpr bool kEveryImage = false;
  static constexpr bool kUsesDepth = true;

  static std::string Finding(const PointTracker& tracker) {
    const std::string still_parts = tracker.StillPartsFinding();
    return still_parts.empty() ? tracker.PairFinding() : still_parts;
  }
};

}  // namespace

PointTrackerNode::PointTrackerNode(const Config& config, const ros::NodeHandle& node,
                                   const ros::NodeHandle& private_node)
    : node_(std::make_shared<TrackerNode<PointNodeTraits>>(config, node, private_node)) {}

}  // namespace plm_vins
