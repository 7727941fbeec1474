// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/pose_graph_config.h"

#include <filesystem>

namespace plm_vins {

std::string PoseGraphConfig::MapFile() const {
  return (std::filesystem::path(save_path) / "pose_graph.plm").string();
}

ConfigKeys PoseGraphKeys(PoseGraphConfig* pose_graph) {
  using Key = ConfigKey;
  return {
      Key::Flag("loop_closure", &pose_graph->loop_closure),
      Key::Flag("bundle_adjustment", &pose_graph->bundle_adjustment),
      Key::Text("pose_graph_save_path", &pose_graph->save_path),
      Key::Flag("load_previous_pose_graph", &pose_graph->load_previous),
  };
}

}  // namespace plm_vins
