// SPDX-License-Identifier: BSD-3-Clause
// The line front end as the nodelet plm_vins/LineFeatureTracker, which does nothing where the
// configuration does without lines.
#include <pluginlib/class_list_macros.hpp>

#include "common/ros/nodelet_of.h"
#include "linefeature_tracker/ros/line_node_traits.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {

class LineFeatureTrackerNodelet : public NodeletOf<TrackerNode<LineNodeTraits>> {
 private:
  bool IsWanted(const Config& config) const override { return WantsLines(config); }
};

}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::LineFeatureTrackerNodelet, nodelet::Nodelet)
