// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "test/fuzz/mutator.h"

namespace plm_vins::fuzz {

// Returns the folder of this process; it remains if the target crashes.
inline std::filesystem::path Folder() {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("plm_vins_fuzz_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

inline void Write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline Bytes ReadFile(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return ToBytes(text.str());
}

}  // namespace plm_vins::fuzz
