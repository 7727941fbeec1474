// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_checks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/stereo_pairs.h"
#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

constexpr double kHardlyAnything = 0.01;  // share of the image
constexpr const char* kNoiseKeys[] = {"acc_n", "gyr_n", "acc_w", "gyr_w"};

bool Has(const ConfigEntries& entries, const std::string& key) { return entries.count(key) > 0; }

bool HasNoise(const ConfigEntries& entries) {
  return std::any_of(std::begin(kNoiseKeys), std::end(kNoiseKeys),
                     [&](const char* key) { return Has(entries, key); });
}

// Returns the path of the mask, which is relative to the configuration file; empty if no mask is
// used.
std::string MaskPath(const Config& config) {
  const std::string& mask = config.points.fisheye_mask;
  if (mask.empty() || !config.points.fisheye) return "";
  return (std::filesystem::path(config.file).parent_path() / mask).string();
}

// A missing or wrong size is reported separately.
bool HasSize(const CameraParameters& camera) { return camera.width > 0 && camera.height > 0; }

void CheckPrincipalPoint(const CameraParameters& camera, const std::string& prefix,
                         const Report& report) {
  if (!HasSize(camera)) return;
  if (camera.cx > camera.width) {
    report(prefix + "image_width",
           "the principal point is beyond the right edge; correct it or the image size");
  }
  if (camera.cy > camera.height) {
    report(prefix + "image_height",
           "the principal point is below the bottom edge; correct it or the image size");
  }
}

void CheckExtrinsics(const ConfigEntries& entries, const Config& config, const Report& report) {
  const bool is_unknown =
      config.sensor.estimate_extrinsic == SensorConfig::ExtrinsicMode::kCalibrateRotation;
  const bool has_others = config.sensor.cameras.size() > 1;
  if (is_unknown && !has_others) return;
  for (const char* key : {"extrinsicRotation", "extrinsicTranslation"}) {
    if (Has(entries, key)) continue;
    report(key, is_unknown ? "is missing; several cameras need it even with estimate_extrinsic: 2"
                           : "is missing; add it, or set estimate_extrinsic: 2");
  }
}

// Two cameras at one place that look in the same direction are probably one transform, copied.
bool HaveOnePose(const Rigid3d& T_A_B) {
  constexpr double kDistance = 1e-3, kAngle = 0.05;  // [m], [rad]
  return T_A_B.translation.norm() < kDistance && SO3Log(T_A_B.rotation).norm() < kAngle;
}

void CheckTransforms(const ConfigEntries& entries, const std::vector<CameraSensor>& cameras,
                     const Report& report) {
  const auto is_given = [&](int camera) {
    return Has(entries, camera == 0 ? "extrinsicTranslation" : TransformKey(camera));
  };
  for (int i = 1; i < static_cast<int>(cameras.size()); ++i) {
    for (int j = 0; j < i; ++j) {
      if (!is_given(i) || !is_given(j)) continue;
      if (!HaveOnePose(cameras[i].T_B_C.Inverse() * cameras[j].T_B_C)) continue;
      report(TransformKey(i),
             "equals the transform of camera " + std::to_string(j) + "; correct one of them");
    }
  }
}

void CheckPairs(const SensorConfig& sensor, const Report& report) {
  if (const Problem problem = CheckStereoPairs(sensor)) report("stereo_pairs", *problem);
}

void CheckShutter(const SensorConfig& sensor, const Report& report) {
  if (sensor.rolling_shutter && !(sensor.rolling_shutter_tr > 0)) {
    report("rolling_shutter_tr", "is 0; give the read-out time [s], or set rolling_shutter: 0");
  }
}

void CheckNoise(const ConfigEntries& entries, const Report& report) {
  if (!HasNoise(entries)) return;
  for (const char* key : kNoiseKeys) {
    if (!Has(entries, key)) report(key, "is missing; give all of acc_n, gyr_n, acc_w, gyr_w");
  }
}

// Returns the power of the distance from the center by which a coefficient changes a position.
int PowerOf(CameraParameters::Model model, int coefficient) {
  if (model == CameraParameters::Model::kPinholeEquidistant) return 2 * (coefficient + 1);
  return coefficient < 2 ? 2 * (coefficient + 1) : 1;
}

// The coefficients of a lens with a narrow view may be large, as may those of an MEI model with a
// large xi, whose image plane is small. So what they do at the corner of the image is limited.
void CheckDistortion(const CameraParameters& camera, const std::string& prefix,
                     const Report& report) {
  constexpr double kMostChange = 10;  // of the distance from the center, relative
  if (!(camera.fx > 0 && camera.fy > 0)) return;
  const double x = std::max(camera.cx, camera.width - camera.cx) / camera.fx;
  const double y = std::max(camera.cy, camera.height - camera.cy) / camera.fy;
  const double radius = std::hypot(x, y);
  for (int i = 0; i < static_cast<int>(camera.distortion.size()); ++i) {
    const double change =
        std::abs(camera.distortion[i]) * std::pow(radius, PowerOf(camera.model, i));
    if (!(change > kMostChange)) continue;
    report(
        prefix + "distortion_parameters",
        "the coefficient " + ToText(ConfigValue(camera.distortion[i])) +
            " moves the corner of the image by more than ten times its distance from the center");
  }
}

void CheckImages(const Config& config, const Report& report) {
  for (size_t i = 0; i < config.sensor.cameras.size(); ++i) {
    const CameraParameters& camera = config.sensor.cameras[i].parameters;
    CheckPrincipalPoint(camera, CameraPrefix(static_cast<int>(i)), report);
    if (!HasSize(camera)) continue;
    CheckDistortion(camera, CameraPrefix(static_cast<int>(i)), report);
    if (config.points.min_dist >= std::min(camera.width, camera.height)) {
      report("min_dist", "must be smaller than the image");
    }
  }
}

Problem CheckName(const std::string& name) {
  if (name.empty()) return "is empty; give a name";
  if (name.find_first_of(" \t\r\n") != std::string::npos) return "must be a name without spaces";
  return std::nullopt;
}

using NamedKeys = std::vector<std::pair<std::string, std::string>>;  // keys with their values

void CheckDistinct(const NamedKeys& keys, const Report& report) {
  std::map<std::string, std::string> key_of_name;
  for (const auto& [key, name] : keys) {
    const auto [other, is_new] = key_of_name.emplace(name, key);
    if (!is_new) report(key, "is the same as " + other->second);
  }
}

void CheckTopics(const SensorConfig& sensor, const Report& report) {
  NamedKeys topics;
  for (size_t i = 0; i < sensor.cameras.size(); ++i) {
    topics.emplace_back(TopicKey(static_cast<int>(i)), sensor.cameras[i].image_topic);
  }
  topics.emplace_back("imu_topic", sensor.imu_topic);
  if (sensor.depth) topics.emplace_back("depth_topic", sensor.depth->topic);
  for (const auto& [key, topic] : topics) {
    if (const Problem problem = CheckName(topic)) report(key, *problem);
  }
  CheckDistinct(topics, report);
}

// Frame names must be distinct, since each frame has one parent.
void CheckFrames(const Config& config, const Report& report) {
  const OutputConfig& output = config.output;
  NamedKeys frames = {{"world_frame", output.world_frame},
                      {"body_frame", output.body_frame},
                      {"camera_frame", output.camera_frame},
                      {"manhattan_frame", output.manhattan_frame}};
  if (config.pose_graph.loop_closure) frames.emplace_back("map_frame", output.map_frame);
  if (!output.base_frame.empty()) frames.emplace_back("base_frame", output.base_frame);
  for (const auto& [key, name] : frames) {
    if (const Problem problem = CheckFrameName(name)) report(key, *problem);
  }
  CheckDistinct(frames, report);
}

// Estimates the share of the image without rays on a grid of pixels.
double ShareWithoutRay(const CameraModel& camera) {
  constexpr int kColumns = 40, kRows = 30;
  const CameraParameters& parameters = camera.parameters();
  int without = 0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const int column = i % kColumns, row = i / kColumns;
    const Eigen::Vector2d share((column + 0.5) / kColumns, (row + 0.5) / kRows);
    const Eigen::Vector2d size(parameters.width, parameters.height);
    if (!camera.Unproject(share.cwiseProduct(size))) ++without;
  }
  return static_cast<double>(without) / (kColumns * kRows);
}

// Reports pixels without rays, and so without features, because the distortion folds back inside
// the image. Pixels of a fisheye at 90 degrees and beyond do not count.
void CheckFold(const CameraParameters& parameters, const std::string& prefix,
               const Report& report) {
  const auto camera = CameraModel::Create(parameters);
  const Eigen::Vector3d sideways(1, 0, 0.02);
  if (camera->Project(sideways)) return;  // only pixels not in front of the camera lack rays
  const double share = ShareWithoutRay(*camera);
  if (share <= kHardlyAnything) return;
  report(prefix + "model_type",
         std::to_string(std::lround(100 * share)) +
             " % of the image has no viewing ray with this distortion and gets no features; check "
             "that the coefficients belong to this model and image size");
}

void CheckMask(const Config& config, const Report& report) {
  const std::string mask = MaskPath(config);
  std::error_code error;  // the path may exceed the length limit of the file system
  if (!mask.empty() && !std::filesystem::is_regular_file(mask, error)) {
    report("fisheye_mask", "cannot find the file " + mask);
  }
}

}  // namespace

Problem CheckFrameName(const std::string& name) {
  if (const Problem problem = CheckName(name)) return problem;
  if (name.front() == '/') return "must not begin with a slash: tf2 rejects it";
  return std::nullopt;
}

void CheckTogether(const ConfigEntries& entries, const Config& config, const Report& report) {
  CheckExtrinsics(entries, config, report);
  CheckTransforms(entries, config.sensor.cameras, report);
  CheckPairs(config.sensor, report);
  CheckShutter(config.sensor, report);
  CheckNoise(entries, report);
  CheckImages(config, report);
  CheckTopics(config.sensor, report);
  CheckFrames(config, report);
  CheckMask(config, report);
}

void CheckIntention(const ConfigEntries& entries, const Config& config, const Report& report) {
  const PointTrackerConfig& points = config.points;
  // VINS-Mono then uses a mask of its own, which does not exist here.
  if (Has(entries, "fisheye") && points.fisheye && MaskPath(config).empty()) {
    report(
        "fisheye",
        "fisheye_mask is not set, so features are allowed everywhere; name an image file, or set "
        "fisheye: 0");
  }
  if (!points.fisheye_mask.empty() && !points.fisheye) {
    report("fisheye_mask", "has no effect with fisheye: 0; set fisheye: 1 to use it");
  }
  if (!MaskPath(config).empty()) return;
  for (size_t i = 0; i < config.sensor.cameras.size(); ++i) {
    CheckFold(config.sensor.cameras[i].parameters, CameraPrefix(static_cast<int>(i)), report);
  }
}

void FinishConfig(const ConfigEntries& entries, Config* config) {
  config->points.fisheye_mask = MaskPath(*config);
  config->points.fisheye = !config->points.fisheye_mask.empty();
  SensorConfig& sensor = config->sensor;
  if (HasNoise(entries) && sensor.imu_noise_model == SensorConfig::ImuNoiseModel::kVins) {
    sensor.imu_noise = DensitiesFromSamples(sensor.imu_noise, sensor.imu_rate);
  }
  sensor.imu_noise_model = SensorConfig::ImuNoiseModel::kContinuous;
}

}  // namespace plm_vins
