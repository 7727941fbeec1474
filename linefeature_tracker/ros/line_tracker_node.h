// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "common/config/config.h"

namespace plm_vins {

// TrackerNode of the line tracker, idle if the configuration disables lines, compiled once for node
// and nodelet.
class LineTrackerNode {
 public:
  LineTrackerNode(const Config& config, const ros::NodeHandle& node,
                  const ros::NodeHandle& private_node);

 private:
  std::shared_ptr<void> node_;
};

}  // namespace plm_vins
