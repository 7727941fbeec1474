// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>

#include <exception>
#include <optional>

#include "common/ros/node_config.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {

// A TrackerNode as a nodelet: images come from another nodelet of the same manager without a copy.
// Where the configuration has problems they are logged as by the node, and loading fails; the
// manager goes on.
template <typename Traits>
class TrackerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      // Not the multi-threaded handles: one callback at a time.
      tracker_.emplace(LoadNodeConfig(getPrivateNodeHandle()), getNodeHandle(),
                       getPrivateNodeHandle());
    } catch (const std::exception& error) {
      LogFatal(error);
      throw;
    }
  }

  std::optional<TrackerNode<Traits>> tracker_;
};

}  // namespace plm_vins
