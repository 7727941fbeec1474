// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace plm_vins {

// Returns the only document of a YAML text. Throws YAML::ParserException, with the place, if the
// text is not valid or if a second document with content begins, which would be ignored.
YAML::Node ParseYamlDocument(const std::string& text);

}  // namespace plm_vins
