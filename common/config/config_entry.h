// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// A key with its unparsed value.
struct ConfigEntry {
  YAML::Node value;
  std::string location;  // "FILE:LINE", or the prefix of an override
  std::string name;      // "FILE:LINE: KEY" or "--set KEY", for messages
  bool is_override = false;
};

// Keys of nested maps are joined by a dot: "projection_parameters.fx".
using ConfigEntries = std::map<std::string, ConfigEntry>;

// Reads the entries of the file and replaces or adds the overrides, which messages name by
// `override_prefix` and key. Adds duplicate keys to `problems`. Returns nullopt, and adds a
// problem, if the file cannot be read, is not YAML, or has more than one document.
std::optional<ConfigEntries> ReadConfigEntries(const std::string& file,
                                               const std::map<std::string, std::string>& overrides,
                                               const std::string& override_prefix,
                                               std::vector<std::string>* problems);

}  // namespace plm_vins
