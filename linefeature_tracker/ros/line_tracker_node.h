// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "common/config/config.h"

namespace plm_vins {

// Returns the TrackerNode of the line tracker, or nullptr if the configuration disables lines.
std::shared_ptr<void> MakeLineTrackerNode(const Config& config, const ros::NodeHandle& node,
                                          const ros::NodeHandle& private_node);

}  // namespace plm_vins
