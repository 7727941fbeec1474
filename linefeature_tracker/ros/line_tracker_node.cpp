// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/ros/line_tracker_node.h"

#include <string>

#include "common/ros/optional_node.h"
#include "linefeature_tracker/line_tracking_stage.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {
namespace {

// Traits of the line tracker for TrackerNode.
struct LineNodeTraits {
  using Stage = LineTrackingStage;

  static constexpr char kFeatureTopic[] = "linefeature";
  static constexpr char kAnnotatedTopic[] = "linefeature_img";
  static constexpr char kDiagnostics[] = "line tracking";
  // Processes every image: the point tracker, possibly another program, decides which images are
  // used.
  static constexpr bool kEveryImage = true;
  static constexpr bool kUsesDepth = false;

  // The point tracker judges the pairs of cameras.
  static std::string Finding(const LineTracker&) { return ""; }
};

struct LineSwitch {
  static constexpr char kKey[] = "use_lines";
  static bool IsOn(const Config& config) { return config.use_lines; }
};

}  // namespace

LineTrackerNode::LineTrackerNode(const Config& config, const ros::NodeHandle& node,
                                 const ros::NodeHandle& private_node)
    : node_(std::make_shared<OptionalNode<TrackerNode<LineNodeTraits>, LineSwitch>>(
          config, node, private_node)) {}

}  // namespace plm_vins
