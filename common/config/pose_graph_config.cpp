// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/pose_graph_config.h"

#include <filesystem>

namespace plm_vins {

std::string PoseGraphConfig::MapFile() const {
  return (std::filesystem::path(save_path) / "pose_graph.plm").string();
}

ConfigKeys<PoseGraphConfig> PoseGraphKeys() {
  using Key = ConfigKey<PoseGraphConfig>;
  using P = PoseGraphConfig;
  return {
      Key::Flag("loop_closure", &P::loop_closure),
      Key::Flag("bundle_adjustment", &P::bundle_adjustment),
      Key::Text("pose_graph_save_path", &P::save_path),
      Key::Flag("load_previous_pose_graph", &P::load_previous),
  };
}

}  // namespace plm_vins
