// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config.h"

#include <algorithm>

#include "common/config/camera_keys.h"
#include "common/config/config_checks.h"
#include "common/config/config_entry.h"
#include "common/config/config_keys.h"
#include "common/config/nearest_word.h"
#include "common/config/vins_fusion.h"
#include "common/format.h"

namespace plm_vins {
namespace {

bool Contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool IsInGroup(const std::string& key, const std::string& group) {
  return key.rfind(group + ".", 0) == 0;
}

// Loads one file and collects problems.
class Loader {
 public:
  Loader(const std::string& file, const std::map<std::string, std::string>& overrides,
         const std::string& override_prefix) {
    config_.file = file;
    config_.overrides = overrides;
    const auto entries = ReadConfigEntries(file, overrides, override_prefix, &problems_);
    if (!entries) throw ConfigError(problems_);
    entries_ = *entries;
    if (!ReplaceVinsFusionKeys(file, &entries_, &ignored_, &problems_)) {
      throw ConfigError(problems_);
    }
    std::vector<std::string> model_types;
    for (int camera = 0; camera < CameraCount(entries_); ++camera) {
      model_types.push_back(ModelTypeAsWritten(CameraPrefix(camera)));
      if (!IsModelType(model_types.back())) unknown_cameras_.push_back(CameraPrefix(camera));
    }
    keys_ = AllKeys(model_types, &config_);
    for (const ConfigKey& key : keys_) known_.push_back(key.name);
  }

  Config Load() {
    for (const ConfigKey& key : keys_) Read(key);
    RemoveDepthWithoutTopic(&config_.sensor);
    for (const auto& [name, entry] : entries_) CheckKnown(name);
    for (const std::string& prefix : unknown_cameras_) CheckCalibrationGroups(prefix);
    CheckTogether(entries_, config_, [this](const auto& key, const auto& text) { Add(key, text); });
    if (!problems_.empty()) throw ConfigError(problems_);
    AddWarnings();
    FinishConfig(entries_, &config_);
    return config_;
  }

 private:
  std::string ModelTypeAsWritten(const std::string& prefix) const {
    const auto entry = entries_.find(prefix + "model_type");
    return entry == entries_.end() ? "" : ScalarText(entry->second.value).value_or("");
  }

  void Read(const ConfigKey& key) {
    const auto entry = entries_.find(key.name);
    if (entry == entries_.end()) {
      const bool has_broken_group = entries_.count(key.name.substr(0, key.name.find('.'))) > 0;
      if (key.required && !has_broken_group) {
        Add(key.name, "is missing; add it (config/reference.yaml explains it)");
      }
      return;
    }
    const auto text = ScalarText(entry->second.value);
    if (const Problem problem = key.read(entry->second.value)) {
      const std::string standard = ToText(key.value());  // an invalid value is not stored
      Add(key.name, (text ? "\"" + *text + "\" " : "") + *problem +
                        (key.has_default ? " (default " + standard + ")" : ""));
    }
  }

  void CheckKnown(const std::string& name) {
    if (Contains(known_, name)) return;
    if (Contains(IgnoredKeys(), name)) {
      ignored_.push_back(name);
      return;
    }
    if (IsUnsupportedCoefficient(name)) {
      return Add(name, "is not supported: calibrate with k1, k2, p1, p2 only");
    }
    const auto keys = KeysOfGroup(name);
    if (!keys.empty()) {
      return Add(name, "must be a group of keys, indented below it: " + JoinTexts(keys, ", "));
    }
    // Calibration keys are not reported if the camera model is unknown, since the model determines
    // the valid ones.
    const bool of_camera = name.find("_parameters") != std::string::npos;
    if (of_camera && !unknown_cameras_.empty()) return;
    const auto nearest = NearestWord(name, known_);
    Add(name, "unknown key" + (nearest ? "; did you mean " + *nearest + "?" : "; remove it"));
  }

  // Returns whether the coefficient belongs to a longer polynomial, such as OpenCV's.
  bool IsUnsupportedCoefficient(const std::string& name) const {
    const size_t length = name.size() - std::min<size_t>(name.size(), 2);
    const std::string group = name.substr(0, length), coefficient = name.substr(length);
    return Contains(known_, group + "p1") && coefficient >= "k3" && coefficient <= "k6";
  }

  std::vector<std::string> KeysOfGroup(const std::string& group) const {
    std::vector<std::string> keys;
    for (const std::string& key : known_) {
      if (IsInGroup(key, group)) keys.push_back(key.substr(group.size() + 1));
    }
    return keys;
  }

  void CheckCalibrationGroups(const std::string& prefix) {
    for (const char* name : {"projection_parameters", "distortion_parameters"}) {
      const std::string group = prefix + name;
      const bool has_keys = std::any_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
        return IsInGroup(entry.first, group);
      });
      if (has_keys) continue;
      Add(group, "is missing; model_type determines its keys (config/reference.yaml lists them)");
    }
  }

  void AddWarnings() {
    if (!ignored_.empty()) {
      config_.warnings.push_back(config_.file +
                                 ": keys without effect: " + JoinTexts(ignored_, ", "));
    }
    CheckIntention(entries_, config_, [this](const std::string& key, const std::string& text) {
      config_.warnings.push_back(At(key) + text);
    });
  }

  void Add(const std::string& key, const std::string& problem) {
    problems_.push_back(At(key) + problem);
  }

  // Returns "FILE:LINE: KEY: ", or the override option and key.
  std::string At(const std::string& key) const {
    const auto entry = entries_.find(key);
    return (entry == entries_.end() ? config_.file + ": " + key : entry->second.name) + ": ";
  }

  Config config_;
  ConfigEntries entries_;
  std::vector<std::string> unknown_cameras_;  // prefixes of cameras with an unknown model
  ConfigKeys keys_;
  std::vector<std::string> known_;    // names of the keys
  std::vector<std::string> ignored_;  // names of keys without effect
  std::vector<std::string> problems_;
};

}  // namespace

ConfigError::ConfigError(const std::vector<std::string>& problems)
    : std::runtime_error(JoinTexts(problems, "\n")), problems_(problems) {}

Config LoadConfig(const std::string& file, const std::map<std::string, std::string>& overrides,
                  const std::string& override_prefix) {
  return Loader(file, overrides, override_prefix).Load();
}

std::vector<std::pair<std::string, ConfigValue>> EffectiveValues(const Config& config) {
  std::vector<std::pair<std::string, ConfigValue>> values;
  Config copy = config;
  for (const ConfigKey& key : KeysOf(&copy)) {
    values.emplace_back(key.name, key.value());
  }
  return values;
}

}  // namespace plm_vins
