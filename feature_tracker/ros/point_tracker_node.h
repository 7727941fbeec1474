// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "common/config/config.h"

namespace plm_vins {

// Returns the TrackerNode of the point tracker.
std::shared_ptr<void> MakePointTrackerNode(const Config& config, const ros::NodeHandle& node,
                                           const ros::NodeHandle& private_node);

}  // namespace plm_vins
