// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/yaml_hint.h"

#include <cctype>
#include <sstream>
#include <vector>

namespace plm_vins {
namespace {

constexpr char kBlanks[] = " \t\r";

bool IsTabIndented(const std::string& line) {
  return line.substr(0, line.find_first_not_of(kBlanks)).find('\t') != std::string::npos;
}

// Detects "max_cnt:100", which is a single word in YAML.
bool LacksSpace(const std::string& line) {
  size_t i = line.find_first_not_of(kBlanks);
  if (i == std::string::npos) return false;
  const size_t begin = i;
  while (i < line.size() && (std::isalnum(static_cast<unsigned char>(line[i])) || line[i] == '_')) {
    ++i;
  }
  return i > begin && i + 1 < line.size() && line[i] == ':' &&
         std::string(kBlanks).find(line[i + 1]) == std::string::npos;
}

std::string HintOn(const std::string& line) {
  if (IsTabIndented(line)) return "it is indented by a tab, use spaces";
  if (LacksSpace(line)) return "a space is missing after the colon";
  return "";
}

// Returns the lines up to `last`, counted from 0.
std::vector<std::string> LinesUpTo(int last, const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; static_cast<int>(lines.size()) <= last && std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

// Inspects the previous line as well, since the parser reports a truncated line at the next one.
std::string YamlHint(const std::string& text, int line) {
  const std::vector<std::string> lines = LinesUpTo(line, text);
  for (size_t i = lines.size(); i > 0 && i + 2 > lines.size(); --i) {
    const std::string hint = HintOn(lines[i - 1]);
    if (!hint.empty()) return "look at line " + std::to_string(i) + ": " + hint;
  }
  return "are the keys of each group indented alike, with a colon and a space behind each?";
}

}  // namespace plm_vins
