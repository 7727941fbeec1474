// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Returns all keys of all modules, bound to the configuration, which gets as many cameras as there
// are types, and a depth sensor. A new key needs a line in the list of its module and one in
// config/reference.yaml.
ConfigKeys AllKeys(const std::vector<std::string>& model_types, Config* config);

// Returns all keys of a file that is equivalent to this configuration, likewise.
ConfigKeys KeysOf(Config* config);

// Clamps every number that a program has set to the range of its key, so that a file with these
// numbers can be read.
void KeepInRange(Config* config);

// Keys of VINS-Mono and its successors without effect here (vocabulary, output paths, threads,
// wall-clock limits).
const std::vector<std::string>& IgnoredKeys();

}  // namespace plm_vins
