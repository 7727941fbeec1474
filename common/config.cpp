// SPDX-License-Identifier: BSD-3-Clause
#include "common/config.h"

#include <algorithm>

#include "common/config/config_checks.h"
#include "common/config/config_entry.h"
#include "common/config/config_keys.h"
#include "common/config/nearest_word.h"

namespace plm_vins {
namespace {

std::string JoinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

// One loading of a file; collects problems along the way.
class Loader {
 public:
  Loader(const std::string& file, const std::map<std::string, std::string>& overrides) {
    draft_.file = file;
    const auto entries = ReadConfigEntries(file, overrides, &problems_);
    if (!entries) throw ConfigError(problems_);
    entries_ = *entries;
  }

  Config Load() {
    Read(ModelTypeKey());
    for (const ConfigKey& key : GeneralKeys()) Read(key);
    if (draft_.model_type) {
      for (const ConfigKey& key : CameraKeys(*draft_.model_type)) Read(key);
    }
    for (const auto& [name, entry] : entries_) CheckKnown(name);
    CheckTogether(entries_, draft_, [this](const auto& key, const auto& text) { Add(key, text); });
    if (!problems_.empty()) throw ConfigError(problems_);
    return FinishConfig(entries_, draft_);
  }

 private:
  void Read(const ConfigKey& key) {
    known_.push_back(key.name);
    const auto entry = entries_.find(key.name);
    if (entry == entries_.end()) {
      if (key.required) Add(key.name, "is missing; add it (config/reference.yaml explains it)");
      return;
    }
    ConfigDraft defaults;
    const auto text = ScalarText(entry->second.value);
    if (const Problem problem = key.read(entry->second.value, draft_)) {
      const std::string standard = key.required ? "" : key.print(defaults);
      Add(key.name, (text ? "\"" + *text + "\" " : "") + *problem +
                        (standard.empty() ? "" : " (default " + standard + ")"));
    }
  }

  void CheckKnown(const std::string& name) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) return;
    const auto& ignored = IgnoredKeys();
    if (std::find(ignored.begin(), ignored.end(), name) != ignored.end()) {
      draft_.ignored_keys.push_back(name);
      return;
    }
    // Without a model it is not known which calibration keys there should be.
    if (!draft_.model_type && name.find("_parameters.") != std::string::npos) return;
    const auto nearest = NearestWord(name, known_);
    Add(name, "unknown key" + (nearest ? "; did you mean " + *nearest + "?" : "; remove it"));
  }

  void Add(const std::string& key, const std::string& problem) {
    const auto entry = entries_.find(key);
    const std::string location = entry == entries_.end() ? draft_.file : entry->second.location;
    problems_.push_back(location + ": " + key + ": " + problem);
  }

  ConfigDraft draft_;
  ConfigEntries entries_;
  std::vector<std::string> known_;
  std::vector<std::string> problems_;
};

}  // namespace

ConfigError::ConfigError(const std::vector<std::string>& problems)
    : std::runtime_error(JoinLines(problems)), problems_(problems) {}

Config LoadConfig(const std::string& file, const std::map<std::string, std::string>& overrides) {
  return Loader(file, overrides).Load();
}

}  // namespace plm_vins
