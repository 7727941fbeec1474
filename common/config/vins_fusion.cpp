// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/vins_fusion.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "common/config/config_key.h"
#include "common/config/sensor_config.h"

namespace plm_vins {
namespace {

// Returns the number of the camera that a key belongs to: 2 for "cam2_model_type", "cam2_calib",
// "image2_topic" and "body_T_cam2". Returns nullopt if the key has no number.
std::optional<int> CameraNumber(const std::string& key) {
  const size_t digit = key.find_first_of("0123456789");
  if (digit == std::string::npos) return std::nullopt;
  const std::string before = key.substr(0, digit), after = key.substr(digit + 1);
  const bool is_camera = (before == "cam" && after.find('_') == 0) ||
                         (before == "image" && after == "_topic") ||
                         (before == "body_T_cam" && after.empty());
  return is_camera ? std::optional(key[digit] - '0') : std::nullopt;
}

bool IsOfCalibration(const std::string& key) {
  return key == "model_type" || key == "image_width" || key == "image_height" ||
         key.find("_parameters") != std::string::npos;
}

YAML::Node MatrixNode(const Eigen::MatrixXd& matrix) {
  YAML::Node node;
  node["rows"] = matrix.rows();
  node["cols"] = matrix.cols();
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    node["data"].push_back(matrix(i / matrix.cols(), i % matrix.cols()));
  }
  return node;
}

// Replaces the keys of one file.
class Replacement {
 public:
  Replacement(const std::string& file, ConfigEntries* entries, std::vector<std::string>* ignored,
              std::vector<std::string>* problems)
      : folder_(std::filesystem::path(file).parent_path()),
        entries_(*entries),
        ignored_(*ignored),
        problems_(*problems) {}

  bool Run() {
    if (!CheckNumbers()) return false;
    IgnoreFurtherCameras();
    RequireImu();
    Rename("image0_topic", "image_topic");
    UseMaskThatExists();
    SplitTransform();
    bool has_all = true;
    for (int camera = 0; camera < CameraCount(entries_); ++camera) {
      has_all = Include("cam" + std::to_string(camera) + "_calib", CameraPrefix(camera)) && has_all;
    }
    return has_all;
  }

 private:
  // Removes the entry and returns it; nullopt if there is none.
  std::optional<ConfigEntry> Take(const std::string& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return std::nullopt;
    const ConfigEntry entry = found->second;
    entries_.erase(found);
    return entry;
  }

  void Put(const std::string& key, const ConfigEntry& entry) {
    const auto [other, is_new] = entries_.emplace(key, entry);
    if (is_new || other->second.is_override) return;
    const auto text = ScalarText(entry.value);
    if (text && text == ScalarText(other->second.value)) return;
    Report(entry, "contradicts " + other->second.name + "; remove one");
  }

  void Report(const ConfigEntry& entry, const std::string& problem) {
    problems_.push_back(entry.name + ": " + problem);
  }

  // A camera without any key, while one with a higher number has some, is a gap.
  bool CheckNumbers() {
    std::map<int, std::string> key_of_camera;
    for (const auto& [key, entry] : entries_) {
      if (const auto camera = CameraNumber(key)) key_of_camera.emplace(*camera, entry.name);
    }
    for (int camera = 1; camera < CameraCount(entries_); ++camera) {
      const auto next = key_of_camera.lower_bound(camera);
      if (next == key_of_camera.end()) return true;  // reported as missing keys
      if (next->first == camera) continue;
      problems_.push_back(next->second + ": camera " + std::to_string(camera) +
                          " has no keys; number the cameras without a gap");
      return false;
    }
    return true;
  }

  void IgnoreFurtherCameras() {
    const int count = CameraCount(entries_);
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      const bool is_ignored = CameraNumber(entry->first).value_or(0) >= count;
      if (is_ignored) ignored_.push_back(entry->first);
      entry = is_ignored ? entries_.erase(entry) : std::next(entry);
    }
  }

  void RequireImu() {
    const auto entry = Take("imu");
    bool has_imu = true;
    if (!entry) return;
    if (const Problem problem = ReadFlag(entry->value, &has_imu)) Report(*entry, *problem);
    if (!has_imu) Report(*entry, "odometry without an IMU is not supported; set imu: 1");
  }

  void Rename(const std::string& from, const std::string& to) {
    if (const auto entry = Take(from)) Put(to, *entry);
  }

  // VINS-Fusion configurations name a mask that is never used and may not exist.
  void UseMaskThatExists() {
    const auto entry = entries_.find("fisheye_mask_path");
    if (entry == entries_.end()) return;
    const auto path = ScalarText(entry->second.value);
    std::error_code error;
    if (path && std::filesystem::is_regular_file(folder_ / *path, error)) {
      Rename("fisheye_mask_path", "fisheye_mask");
    }
  }

  void SplitTransform() {
    const auto entry = Take("body_T_cam0");
    if (!entry) return;
    Eigen::MatrixXd T_B_C(4, 4);
    Rigid3d checked;
    Problem problem = ReadMatrix(entry->value, &T_B_C);
    if (!problem) problem = SetTransform(T_B_C, &checked);
    if (problem) {
      Report(*entry, *problem);
      T_B_C.setIdentity();
    }
    const auto put = [&](const std::string& key, const Eigen::MatrixXd& part) {
      Put(key, {MatrixNode(part), entry->location, entry->name, entry->is_override});
    };
    put("extrinsicRotation", T_B_C.topLeftCorner(3, 3));
    put("extrinsicTranslation", T_B_C.topRightCorner(3, 1));
  }

  // Adds the calibration in the file named by `key`, with the prefix added to its keys.
  bool Include(const std::string& key, const std::string& prefix) {
    const auto naming = Take(key);
    if (!naming) return true;
    const auto name = ScalarText(naming->value);
    if (!name) {
      Report(*naming, "must be the name of a file");
      return false;
    }
    const auto calibration = ReadConfigEntries((folder_ / *name).string(), {}, "", &problems_);
    if (!calibration) {
      Report(*naming, "the calibration of the camera cannot be read from this file");
      return false;
    }
    for (const auto& [part, entry] : *calibration) {
      if (IsOfCalibration(part)) Put(prefix + part, entry);
    }
    return true;
  }

  std::filesystem::path folder_;
  ConfigEntries& entries_;
  std::vector<std::string>& ignored_;
  std::vector<std::string>& problems_;
};

}  // namespace

int CameraCount(const ConfigEntries& entries) {
  int count = 1;
  const auto entry = entries.find("num_of_cam");
  if (entry != entries.end()) ReadInteger(entry->second.value, "", kCameraCounts, &count);
  return count;
}

bool ReplaceVinsFusionKeys(const std::string& file, ConfigEntries* entries,
                           std::vector<std::string>* ignored, std::vector<std::string>* problems) {
  return Replacement(file, entries, ignored, problems).Run();
}

}  // namespace plm_vins
