// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_keys.h"

#include "common/config/camera_keys.h"

namespace plm_vins {
namespace {

// Keys that concern several modules.
ConfigKeys<Config> SharedKeys() {
  using Key = ConfigKey<Config>;
  return {
      Key::Number("freq", "Hz", {0, 1000}, &Config::publish_rate),
      Key::Flag("show_track", &Config::show_track),
      Key::Flag("use_lines", &Config::use_lines),
  };
}

}  // namespace

ConfigKeys<Config> AllKeys(const std::vector<std::string>& model_types) {
  return Join<Config>(
      {Within(&Config::sensor, SensorKeys(model_types)), SharedKeys(),
       Within(&Config::points, PointTrackerKeys()), Within(&Config::lines, LineTrackerKeys()),
       Within(&Config::estimator, EstimatorKeys()), Within(&Config::pose_graph, PoseGraphKeys()),
       Within(&Config::output, OutputKeys())});
}

ConfigKeys<Config> KeysOf(const Config& config) {
  std::vector<std::string> model_types;
  for (const CameraSensor& camera : config.sensor.cameras) {
    model_types.push_back(ModelType(camera.parameters.model));
  }
  return AllKeys(model_types);
}

void KeepInRange(Config* config) {
  for (const ConfigKey<Config>& key : KeysOf(*config)) {
    if (key.keep_in_range) key.keep_in_range(*config);
  }
}

const std::vector<std::string>& IgnoredKeys() {
  static const std::vector<std::string> keys = {"camera_name",
                                                "ex_calib_result_path",
                                                "fast_relocalization",
                                                "fisheye_mask_path",
                                                "flow_back",
                                                "max_solver_time",
                                                "min_loop_num",
                                                "multiple_thread",
                                                "output_path",
                                                "pattern_file",
                                                "save_image",
                                                "support_path",
                                                "use_gpu",
                                                "use_gpu_acc_flow",
                                                "use_gpu_ceres",
                                                "visualize_camera_size",
                                                "visualize_imu_forward",
                                                "voc_file"};
  return keys;
}

}  // namespace plm_vins
