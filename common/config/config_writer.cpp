// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_writer.h"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace plm_vins {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// Every matrix of a configuration is 4x4 or has three rows.
std::string MatrixText(const std::vector<double>& entries) {
  const size_t rows = entries.size() == 16 ? 4 : 3;
  return "!!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(entries.size() / rows) +
         "\n   dt: d\n   data: " + ToText(ConfigValue(entries));
}

std::string ValueText(const ConfigValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return Quoted(*text);
  if (const auto* entries = std::get_if<std::vector<double>>(&value)) return MatrixText(*entries);
  return ToText(value);
}

// Replaces control characters, since a line break would end the comment.
std::string OnOneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

void WriteOverrides(const Config& config, std::ostream* stream) {
  if (config.overrides.empty()) return;
  *stream << OnOneLine("# From " + config.file) << "; values replaced for this run:\n";
  for (const auto& [key, text] : config.overrides) {
    *stream << OnOneLine("#   " + key + ": " + text) << "\n";
  }
}

}  // namespace

void WriteConfig(const Config& config, std::ostream* stream) {
  Config movable = config;
  std::string& mask = movable.points.fisheye_mask;
  if (!mask.empty()) mask = std::filesystem::absolute(mask).string();
  *stream << "%YAML:1.0\n";
  WriteOverrides(config, stream);
  std::string open_group;
  for (const auto& [name, value] : EffectiveValues(movable)) {
    const size_t dot = name.find('.');
    const std::string group = dot == std::string::npos ? "" : name.substr(0, dot);
    if (group != open_group && !group.empty()) *stream << group << ":\n";
    open_group = group;
    *stream << (group.empty() ? name : "   " + name.substr(dot + 1)) << ": " << ValueText(value)
            << "\n";
  }
}

}  // namespace plm_vins
