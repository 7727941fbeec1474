// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// One key with its value, as written.
struct ConfigEntry {
  YAML::Node value;
  std::string location;  // "FILE:LINE"; of an override, what its key comes after
  std::string name;      // "FILE:LINE: KEY" or "--set KEY", for messages
  bool is_override = false;
};

// Keys of nested maps are joined by a dot: "projection_parameters.fx".
using ConfigEntries = std::map<std::string, ConfigEntry>;

// Reads the file into entries and replaces or adds the overrides, which messages name by
// `override_prefix` and key. Adds duplicate keys to `problems`; where there is no such file or it
// is not YAML, or more than one document, adds that and returns nothing.
std::optional<ConfigEntries> ReadConfigEntries(const std::string& file,
                                               const std::map<std::string, std::string>& overrides,
                                               const std::string& override_prefix,
                                               std::vector<std::string>* problems);

}  // namespace plm_vins
