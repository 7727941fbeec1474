// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Returns a hint about the likely mistake in a text that the YAML parser rejects at `line` (from
// 0). The parser reports what it expected, which is rarely what was mistyped.
std::string YamlHint(const std::string& text, int line);

}  // namespace plm_vins
