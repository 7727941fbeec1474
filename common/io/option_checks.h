// SPDX-License-Identifier: BSD-3-Clause
// What the options of programs are checked for where their parser is too lenient.
#pragma once

#include <cstdlib>
#include <string>

namespace plm_vins {

// The message of what is wrong with a path; empty where nothing is. An empty one comes of a
// variable of the shell that is not set.
inline std::string CheckPath(const std::string& path) {
  return path.empty() ? "expected a path, which is empty" : "";
}

// Whether all of the text is one number between the two: "nan" is none.
inline bool IsNumberBetween(double least, double most, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  return is_number && number >= least && number <= most;
}

}  // namespace plm_vins
