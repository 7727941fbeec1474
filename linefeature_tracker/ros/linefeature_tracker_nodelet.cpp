// SPDX-License-Identifier: BSD-3-Clause
// The line front end as the nodelet plm_vins/LineFeatureTracker. It is idle if the configuration
// disables lines.
#include <pluginlib/class_list_macros.hpp>

#include "common/ros/nodelet_of.h"
#include "linefeature_tracker/ros/line_tracker_node.h"

namespace plm_vins {
using LineFeatureTrackerNodelet = NodeletOf<&MakeLineTrackerNode>;
}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::LineFeatureTrackerNodelet, nodelet::Nodelet)
