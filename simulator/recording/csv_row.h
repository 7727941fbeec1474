// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <string>

namespace plm_vins::simulator {

// "stamp,a,b,c\n" with twelve significant digits each.
inline std::string CsvRow(int64_t t_ns, std::initializer_list<double> values) {
  std::string row = std::to_string(t_ns);
  char text[32];
  for (const double value : values) {
    std::snprintf(text, sizeof(text), ",%.12g", value);
    row += text;
  }
  return row + "\n";
}

}  // namespace plm_vins::simulator
