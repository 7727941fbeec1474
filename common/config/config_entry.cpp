// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_entry.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "common/config/yaml_document.h"

namespace plm_vins {
namespace {

std::string Location(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

// Size limits; a configuration has about 100 lines. They reject files given by mistake, such as a
// recording, and recursive or exponentially growing YAML aliases.
constexpr std::streamsize kMaxBytes = 1 << 20;
constexpr size_t kMaxEntries = 1000;
constexpr int kMaxDepth = 2;  // keys and groups of keys

// Reads at most one byte more than kMaxBytes.
std::optional<std::string> ReadTextFile(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  std::string text(kMaxBytes + 1, '\0');
  stream.read(text.data(), kMaxBytes + 1);
  text.resize(static_cast<size_t>(stream.gcount()));
  return text;
}

// Removes OpenCV's "%YAML:1.0", an invalid YAML directive; keeps the line, so that line numbers are
// right.
std::string WithoutDirective(std::string text) {
  if (text.rfind("%YAML", 0) == 0) text.erase(0, text.find('\n'));
  return text;
}

// An OpenCV matrix, complete or not, is a single value; any other map with keys is a group.
bool IsGroup(const YAML::Node& node) {
  return node.IsMap() && node.size() > 0 && !node["data"] && !node["rows"];
}

// Returns whether the path is not a regular file: opening a pipe could block, and reading a device
// could be endless.
bool IsSomethingElse(const std::string& file) {
  std::error_code error;  // the path may exceed the length limit of the file system
  return std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error);
}

std::string TooLarge(bool is_group) {
  const std::string problem = is_group ? "is a group within a group"
                                       : "too many keys, more than " + std::to_string(kMaxEntries);
  return problem + "; is this a configuration file?";
}

std::string AppearsTwice(const ConfigEntry& first) {
  return "appears twice (first at " + first.location + "); remove one";
}

// A relative path is relative to the working directory: ~/.ros under roslaunch.
std::string TriedAt(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path(file);
  if (path.empty() || path.is_absolute()) return "";
  return " (tried " + std::filesystem::absolute(path, error).string() + ")";
}

std::string NameOf(const std::string& location, const std::string& key) {
  return location + ": " + key;
}

void AddProblem(const std::string& location, const std::string& key, const std::string& problem,
                std::vector<std::string>* problems) {
  problems->push_back(NameOf(location, key) + ": " + problem);
}

// Stops at the first exceeded size limit.
bool Flatten(const YAML::Node& map, const std::string& prefix, int depth, const std::string& file,
             ConfigEntries* entries, std::vector<std::string>* problems) {
  for (const auto& item : map) {
    const YAML::Node key_node = item.first, value = item.second;
    const std::string key = prefix + (key_node.IsScalar() ? key_node.Scalar() : "?");
    const std::string location = Location(file, key_node.Mark());
    const bool is_group = IsGroup(value);
    if (entries->size() == kMaxEntries || (is_group && depth == kMaxDepth)) {
      AddProblem(location, key, TooLarge(is_group), problems);
      return false;
    }
    if (is_group) {
      if (!Flatten(value, key + ".", depth + 1, file, entries, problems)) return false;
      continue;
    }
    const auto [entry, is_new] =
        entries->insert({key, ConfigEntry{value, location, NameOf(location, key)}});
    if (!is_new) AddProblem(location, key, AppearsTwice(entry->second), problems);
  }
  return true;
}

bool IsByKalibr(const YAML::Node& root) {
  for (const char* key : {"cam0", "imu0", "accelerometer_noise_density", "relative_config_imu"}) {
    if (root[key]) return true;
  }
  return false;
}

std::optional<YAML::Node> ParseRoot(const std::string& file, const std::string& text,
                                    std::vector<std::string>* problems) {
  try {
    const YAML::Node root = ParseYamlDocument(text);
    if (!root.IsMap()) {
      problems->push_back(file + ": has no \"key: value\" lines; is this a configuration file?");
    } else if (IsByKalibr(root)) {
      problems->push_back(file +
                          ": is a file of Kalibr or OpenVINS; convert it with "
                          "kalibr_to_config.py");
    } else {
      return root;
    }
  } catch (const YAML::Exception& error) {
    problems->push_back(Location(file, error.mark) + ": not valid YAML: " + error.msg +
                        "; check this line and the one before it: indentation by spaces, alike in "
                        "each group, and a space behind each colon");
  }
  return std::nullopt;
}

// Returns the top-level map of the file, or nullopt and adds a problem.
std::optional<YAML::Node> ReadRoot(const std::string& file, std::vector<std::string>* problems) {
  if (IsSomethingElse(file)) {
    problems->push_back(file + ": is not a regular file; give the path of a configuration file");
    return std::nullopt;
  }
  const auto text = ReadTextFile(file);
  if (!text) {
    problems->push_back(file + ": cannot be read; check the path of the configuration file" +
                        TriedAt(file));
    return std::nullopt;
  }
  if (static_cast<std::streamsize>(text->size()) > kMaxBytes) {
    problems->push_back(file + ": longer than 1 MiB; is this a configuration file?");
    return std::nullopt;
  }
  return ParseRoot(file, WithoutDirective(*text), problems);
}

}  // namespace

std::optional<ConfigEntries> ReadConfigEntries(const std::string& file,
                                               const std::map<std::string, std::string>& overrides,
                                               const std::string& override_prefix,
                                               std::vector<std::string>* problems) {
  const auto root = ReadRoot(file, problems);
  if (!root) return std::nullopt;
  ConfigEntries entries;
  if (!Flatten(*root, "", 1, file, &entries, problems)) return std::nullopt;
  for (const auto& [key, text] : overrides) {
    entries.erase(key);
    entries.emplace(key,
                    ConfigEntry{YAML::Node(text), override_prefix, override_prefix + key, true});
  }
  return entries;
}

}  // namespace plm_vins
