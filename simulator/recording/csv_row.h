// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "common/format.h"

namespace plm_vins::simulator {

// Formats "stamp,a,b,c\n" with twelve significant digits for each value.
inline std::string CsvRow(int64_t t_ns, std::initializer_list<double> values) {
  std::string row = std::to_string(t_ns);
  for (const double value : values) row += Format(",%.12g", value);
  return row + "\n";
}

}  // namespace plm_vins::simulator
