// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>

#include <optional>

#include "common/config/config.h"

namespace plm_vins {

// A Node(config, node, private_node) that the configuration can disable: it is then idle and logs
// why. `Switch` defines the key, kKey, and its value, IsOn(config).
template <typename Node, typename Switch>
class OptionalNode {
 public:
  OptionalNode(const Config& config, const ros::NodeHandle& node,
               const ros::NodeHandle& private_node) {
    if (Switch::IsOn(config)) {
      node_.emplace(config, node, private_node);
    } else {
      ROS_INFO("not needed: %s is 0 in %s", Switch::kKey, config.file.c_str());
    }
  }

  bool is_on() const { return node_.has_value(); }

 private:
  std::optional<Node> node_;
};

}  // namespace plm_vins
