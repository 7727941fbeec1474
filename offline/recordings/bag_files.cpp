// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_files.h"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Match(const std::string& pattern) {
  glob_t matches{};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &matches) == 0) {
    files.assign(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  }
  globfree(&matches);
  if (files.empty()) throw std::runtime_error("--bag: no file matches " + pattern);
  return files;
}

std::vector<std::string> BagsIn(const std::string& folder) {
  std::vector<std::string> bags;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bag") bags.push_back(entry.path().string());
  }
  if (bags.empty()) {
    throw std::runtime_error("--bag: the folder " + folder +
                             " has no file *.bag; for a folder in ASL format use --asl");
  }
  return bags;
}

std::vector<std::string> Expand(const std::string& place) {
  std::error_code error;
  if (fs::is_directory(place, error)) return BagsIn(place);
  const bool is_pattern = place.find_first_of("*?[") != std::string::npos;
  return is_pattern && !fs::exists(place, error) ? Match(place) : std::vector<std::string>{place};
}

bool AreOneFile(const std::string& a, const std::string& b) {
  std::error_code error;
  return a == b || fs::equivalent(a, b, error);
}

}  // namespace

std::vector<std::string> FindBags(const std::vector<std::string>& places) {
  std::vector<std::string> bags;
  for (const std::string& place : places) {
    for (const std::string& file : Expand(place)) {
      const auto is_file = [&](const std::string& bag) { return AreOneFile(bag, file); };
      if (std::none_of(bags.begin(), bags.end(), is_file)) bags.push_back(file);
    }
  }
  std::sort(bags.begin(), bags.end());
  return bags;
}

}  // namespace plm_vins
