// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_keys.h"

#include "common/config/camera_keys.h"

namespace plm_vins {
namespace {

// Keys that concern several modules.
ConfigKeys SharedKeys(Config* config) {
  using Key = ConfigKey;
  return {
      Key::Number("freq", "Hz", {0, 1000}, &config->publish_rate),
      Key::Flag("show_track", &config->show_track),
      Key::Flag("use_lines", &config->use_lines),
  };
}

}  // namespace

ConfigKeys AllKeys(const std::vector<std::string>& model_types, Config* config) {
  return Join({SensorKeys(model_types, &config->sensor), SharedKeys(config),
               PointTrackerKeys(&config->points), LineTrackerKeys(&config->lines),
               EstimatorKeys(&config->estimator), PoseGraphKeys(&config->pose_graph),
               OutputKeys(&config->output)});
}

ConfigKeys KeysOf(Config* config) {
  std::vector<std::string> model_types;
  for (const CameraSensor& camera : config->sensor.cameras) {
    model_types.push_back(ModelType(camera.parameters.model));
  }
  return AllKeys(model_types, config);
}

void KeepInRange(Config* config) {
  for (const ConfigKey& key : KeysOf(config)) {
    if (key.keep_in_range) key.keep_in_range();
  }
  RemoveDepthWithoutTopic(&config->sensor);
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
