// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config.h"

#include <algorithm>

#include "common/config/camera_keys.h"
#include "common/config/config_checks.h"
#include "common/config/config_entry.h"
#include "common/config/config_keys.h"
#include "common/config/nearest_word.h"

namespace plm_vins {
namespace {

bool Contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string Join(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

// One loading of a file; collects problems along the way.
class Loader {
 public:
  Loader(const std::string& file, const std::map<std::string, std::string>& overrides) {
    config_.file = file;
    const auto entries = ReadConfigEntries(file, overrides, &problems_);
    if (!entries) throw ConfigError(problems_);
    entries_ = *entries;
    keys_ = AllKeys(ModelTypeAsWritten());
    for (const ConfigKey<Config>& key : keys_) known_.push_back(key.name);
  }

  Config Load() {
    for (const ConfigKey<Config>& key : keys_) Read(key);
    for (const auto& [name, entry] : entries_) CheckKnown(name);
    CheckTogether(entries_, config_, [this](const auto& key, const auto& text) { Add(key, text); });
    if (!problems_.empty()) throw ConfigError(problems_);
    AddWarnings();
    FinishConfig(entries_, &config_);
    return config_;
  }

 private:
  std::string ModelTypeAsWritten() const {
    const auto entry = entries_.find("model_type");
    return entry == entries_.end() ? "" : ScalarText(entry->second.value).value_or("");
  }

  void Read(const ConfigKey<Config>& key) {
    const auto entry = entries_.find(key.name);
    if (entry == entries_.end()) {
      if (key.required) Add(key.name, "is missing; add it (config/reference.yaml explains it)");
      return;
    }
    const auto text = ScalarText(entry->second.value);
    if (const Problem problem = key.read(entry->second.value, config_)) {
      const std::string standard = ToText(key.value(Config()));
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
    // Without a model it is not known which calibration keys there should be.
    const bool of_camera = name.find("_parameters.") != std::string::npos;
    if (of_camera && !IsModelType(ModelTypeAsWritten())) return;
    const auto nearest = NearestWord(name, known_);
    Add(name, "unknown key" + (nearest ? "; did you mean " + *nearest + "?" : "; remove it"));
  }

  void AddWarnings() {
    if (!ignored_.empty()) {
      config_.warnings.push_back(config_.file + ": without effect here: " + Join(ignored_, ", "));
    }
    if (LacksMask(entries_, config_)) {
      config_.warnings.push_back(
          At("fisheye") +
          "no fisheye_mask is named, so corners are allowed everywhere; name an "
          "image file that shows where they are, or set fisheye: 0");
    }
  }

  void Add(const std::string& key, const std::string& problem) {
    problems_.push_back(At(key) + problem);
  }

  // "FILE:LINE: KEY: ".
  std::string At(const std::string& key) const {
    const auto entry = entries_.find(key);
    return (entry == entries_.end() ? config_.file : entry->second.location) + ": " + key + ": ";
  }

  Config config_;
  ConfigEntries entries_;
  ConfigKeys<Config> keys_;
  std::vector<std::string> known_;    // names of the keys
  std::vector<std::string> ignored_;  // the same, without effect here
  std::vector<std::string> problems_;
};

}  // namespace

ConfigError::ConfigError(const std::vector<std::string>& problems)
    : std::runtime_error(Join(problems, "\n")), problems_(problems) {}

Config LoadConfig(const std::string& file, const std::map<std::string, std::string>& overrides) {
  return Loader(file, overrides).Load();
}

std::vector<std::pair<std::string, ConfigValue>> EffectiveValues(const Config& config) {
  std::vector<std::pair<std::string, ConfigValue>> values;
  for (const ConfigKey<Config>& key : AllKeys(ModelType(config.sensor.camera.model))) {
    values.emplace_back(key.name, key.value(config));
  }
  return values;
}

}  // namespace plm_vins
