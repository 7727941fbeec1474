// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/output_config.h"

namespace plm_vins {

ConfigKeys<OutputConfig> OutputKeys() {
  using Key = ConfigKey<OutputConfig>;
  using O = OutputConfig;
  return {
      Key::Text("map_frame", &O::map_frame),
      Key::Text("world_frame", &O::world_frame),
      Key::Text("body_frame", &O::body_frame),
      Key::Text("camera_frame", &O::camera_frame),
      Key::Text("manhattan_frame", &O::manhattan_frame),
      Key::Text("base_frame", &O::base_frame),
      Key::Flag("publish_tf", &O::publish_tf),
  };
}

}  // namespace plm_vins
