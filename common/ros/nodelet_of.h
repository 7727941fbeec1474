// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <exception>
#include <optional>

#include "common/config/config.h"
#include "common/ros/node_config.h"

namespace plm_vins {

// A Node(config, node, private_node) as a nodelet: what another nodelet of the same manager
// publishes comes without a copy. Where the configuration has problems they are logged as by the
// node, and loading fails; the manager goes on.
template <typename Node>
class NodeletOf : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      const Config config = LoadNodeConfig(getPrivateNodeHandle());
      // Not the multi-threaded handles: one callback at a time.
      node_.emplace(config, getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      LogFatal(error);
      throw;
    }
  }

  std::optional<Node> node_;
};

}  // namespace plm_vins
