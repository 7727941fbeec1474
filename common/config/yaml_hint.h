// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// What may be wrong with a text that the YAML parser refuses at `line` (from 0), for messages: the
// parser says what it did not find, which is mostly not what was mistyped.
std::string YamlHint(const std::string& text, int line);

}  // namespace plm_vins
