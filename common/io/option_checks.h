// SPDX-License-Identifier: BSD-3-Clause
// Validation of command line options where the parser is too lenient.
#pragma once

#include <cstdlib>
#include <string>

namespace plm_vins {

// Returns an error message if the path is empty, as from an unset shell variable; otherwise an
// empty string.
inline std::string CheckPath(const std::string& path) {
  return path.empty() ? "expected a path, which is empty" : "";
}

// Returns whether the whole text is one number in the range; "nan" is not.
inline bool IsNumberBetween(double least, double most, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  return is_number && number >= least && number <= most;
}

}  // namespace plm_vins
