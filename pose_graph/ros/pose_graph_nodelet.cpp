// SPDX-License-Identifier: BSD-3-Clause
// Loop closure as the nodelet plm_vins/PoseGraph.
#include <nodelet/nodelet.h>

#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <optional>

#include "common/ros/node_config.h"
#include "pose_graph/ros/pose_graph_node.h"

namespace plm_vins {

class PoseGraphNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      // Not the multi-threaded handles: one callback at a time.
      node_.emplace(LoadNodeConfig(getPrivateNodeHandle()), getNodeHandle(),
                    getPrivateNodeHandle());
    } catch (const std::exception& error) {
      LogFatal(error);
      throw;
    }
  }

  std::optional<PoseGraphNode> node_;
};

}  // namespace plm_vins

PLUGINLIB_EXPORT_CLASS(plm_vins::PoseGraphNodelet, nodelet::Nodelet)
