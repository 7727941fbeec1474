// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <exception>
#include <memory>

#include "common/config/config.h"
#include "common/ros/node_config.h"

namespace plm_vins {

// Runs the node that kMake(config, node, private_node) returns as a nodelet, which receives
// messages of other nodelets in the same manager without copying. Problems of the configuration are
// logged as the node logs them. Loading then fails, but the manager continues.
template <auto kMake>
class NodeletOf : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      const Config config = LoadNodeConfig(getPrivateNodeHandle());
      // Uses the single-threaded handles, so that callbacks run one at a time.
      node_ = kMake(config, getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      LogFatal(error);
      throw;
    }
  }

  std::shared_ptr<void> node_;
};

}  // namespace plm_vins
