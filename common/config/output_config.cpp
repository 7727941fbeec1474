// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/output_config.h"

namespace plm_vins {

ConfigKeys OutputKeys(OutputConfig* output) {
  using Key = ConfigKey;
  return {
      Key::Text("map_frame", &output->map_frame),
      Key::Text("world_frame", &output->world_frame),
      Key::Text("body_frame", &output->body_frame),
      Key::Text("camera_frame", &output->camera_frame),
      Key::Text("manhattan_frame", &output->manhattan_frame),
      Key::Text("base_frame", &output->base_frame),
      Key::Flag("publish_tf", &output->publish_tf),
  };
}

}  // namespace plm_vins
