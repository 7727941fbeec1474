// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config_key.h"

namespace plm_vins {

struct PoseGraphConfig {
  bool loop_closure = false;      // recognise places and correct the drift of odometry in a map
  bool bundle_adjustment = true;  // of the map, in the end of an offline run
  std::string save_path;          // folder of the map; empty: the current one
  bool load_previous = false;     // start in the map that was saved there

  // Where the map is saved, and read from.
  std::string MapFile() const;
};

ConfigKeys<PoseGraphConfig> PoseGraphKeys();

}  // namespace plm_vins
