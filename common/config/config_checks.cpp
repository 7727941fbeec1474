// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_checks.h"

#include <algorithm>
#include <filesystem>

namespace plm_vins {
namespace {

constexpr const char* kNoiseKeys[] = {"acc_n", "gyr_n", "acc_w", "gyr_w"};

bool Has(const ConfigEntries& entries, const std::string& key) { return entries.count(key) > 0; }

bool HasNoise(const ConfigEntries& entries) {
  return std::any_of(std::begin(kNoiseKeys), std::end(kNoiseKeys),
                     [&](const char* key) { return Has(entries, key); });
}

// A mask is named relative to the configuration file. Empty where none is to be used.
std::string MaskPath(const ConfigDraft& draft) {
  const std::string& mask = draft.points.fisheye_mask;
  if (mask.empty() || draft.fisheye == false) return "";
  return (std::filesystem::path(draft.file).parent_path() / mask).string();
}

void CheckExtrinsics(const ConfigEntries& entries, const ConfigDraft& draft, const Report& report) {
  if (draft.sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation) return;
  for (const char* key : {"extrinsicRotation", "extrinsicTranslation"}) {
    if (!Has(entries, key)) report(key, "is missing; add it, or set estimate_extrinsic: 2");
  }
}

void CheckNoise(const ConfigEntries& entries, const Report& report) {
  if (!HasNoise(entries)) return;
  for (const char* key : kNoiseKeys) {
    if (!Has(entries, key)) report(key, "is missing; give all of acc_n, gyr_n, acc_w, gyr_w");
  }
}

void CheckImage(const ConfigDraft& draft, const Report& report) {
  const CameraParameters& camera = draft.sensor.camera;
  if (camera.width == 0 || camera.height == 0) return;  // reported on their own
  if (camera.cx > camera.width) report("image_width", "the principal point is right of the image");
  if (camera.cy > camera.height) report("image_height", "the principal point is below the image");
  if (draft.points.min_dist >= std::min(camera.width, camera.height)) {
    report("min_dist", "must be smaller than the image");
  }
}

void CheckNames(const ConfigDraft& draft, const Report& report) {
  const OutputConfig& output = draft.output;
  const auto check_name = [&](const char* key, const std::string& name) {
    if (name.empty() || name.find_first_of(" \t") != std::string::npos) {
      report(key, "must be a name without spaces");
    }
  };
  check_name("image_topic", draft.sensor.image_topic);
  check_name("imu_topic", draft.sensor.imu_topic);
  check_name("world_frame", output.world_frame);
  check_name("body_frame", output.body_frame);
  check_name("camera_frame", output.camera_frame);
  if (draft.sensor.image_topic == draft.sensor.imu_topic) {
    report("imu_topic", "is the same as image_topic");
  }
  if (output.body_frame == output.world_frame) report("body_frame", "is the same as world_frame");
  if (output.camera_frame == output.world_frame || output.camera_frame == output.body_frame) {
    report("camera_frame", "is the same as another frame");
  }
}

void CheckMask(const ConfigDraft& draft, const Report& report) {
  const std::string mask = MaskPath(draft);
  if (draft.fisheye == true && mask.empty()) {
    report("fisheye_mask", "is missing; name an image file, or set fisheye: 0");
  }
  if (!mask.empty() && !std::filesystem::is_regular_file(mask)) {
    report("fisheye_mask", "there is no file " + mask);
  }
}

CameraParameters::Model CameraModelOf(ConfigDraft::ModelType type) {
  switch (type) {
    case ConfigDraft::ModelType::kMei:
      return CameraParameters::Model::kMei;
    case ConfigDraft::ModelType::kPinhole:
      return CameraParameters::Model::kPinholeRadtan;
    default:
      return CameraParameters::Model::kPinholeEquidistant;
  }
}

}  // namespace

void CheckTogether(const ConfigEntries& entries, const ConfigDraft& draft, const Report& report) {
  CheckExtrinsics(entries, draft, report);
  CheckNoise(entries, report);
  CheckImage(draft, report);
  CheckNames(draft, report);
  CheckMask(draft, report);
}

Config FinishConfig(const ConfigEntries& entries, const ConfigDraft& draft) {
  Config config = draft;
  config.sensor.camera.model = CameraModelOf(*draft.model_type);
  config.points.fisheye_mask = MaskPath(draft);
  if (HasNoise(entries) && draft.imu_noise_model == ConfigDraft::ImuNoiseModel::kVins) {
    config.sensor.imu_noise = DensitiesFromSamples(draft.sensor.imu_noise, draft.imu_rate);
  }
  return config;
}

}  // namespace plm_vins
