// SPDX-License-Identifier: BSD-3-Clause
// The point front end as the nodelet plm_vins/FeatureTracker.
#include <pluginlib/class_list_macros.hpp>

#include "common/ros/nodelet_of.h"
#include "feature_tracker/ros/point_tracker_node.h"

namespace plm_vins {
using FeatureTrackerNodelet = NodeletOf<&MakePointTrackerNode>;
}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::FeatureTrackerNodelet, nodelet::Nodelet)
