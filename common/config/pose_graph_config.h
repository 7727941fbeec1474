// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config_key.h"

namespace plm_vins {

struct PoseGraphConfig {
  bool loop_closure = false;      // recognize places and correct odometry drift in a map
  bool bundle_adjustment = true;  // adjust the map at the end of an offline run
  std::string save_path;          // folder of the map; empty: the current folder
  bool load_previous = false;     // start from the map that was saved there

  // Path to which the map is saved and from which it is loaded.
  std::string MapFile() const;
};

ConfigKeys PoseGraphKeys(PoseGraphConfig* pose_graph);

}  // namespace plm_vins
