// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace plm_vins {

// "text: 4.2 of 15.0"; the format takes both numbers.
inline std::string RefusalText(const char* format, double value, double limit) {
  char text[120];
  std::snprintf(text, sizeof(text), format, value, limit);
  return text;
}

}  // namespace plm_vins
