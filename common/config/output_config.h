// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config_key.h"

namespace plm_vins {

// Names of the tf frames.
struct OutputConfig {
  std::string map_frame = "map";
  std::string world_frame = "world";
  std::string body_frame = "body";
  std::string camera_frame = "camera";
  std::string manhattan_frame = "manhattan";
  std::string base_frame;  // base of a robot whose own tf tree contains the body; empty: none
  bool publish_tf = true;
};

ConfigKeys OutputKeys(OutputConfig* output);

}  // namespace plm_vins
