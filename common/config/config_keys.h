// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Every key of a file whose cameras are of these types: those of all modules. To add one, add a
// line to the list of its module and one to config/reference.yaml.
ConfigKeys<Config> AllKeys(const std::string& model_type,
                           const std::optional<std::string>& second_model_type = std::nullopt);

// Every key of a file that would say the same as this configuration.
ConfigKeys<Config> KeysOf(const Config& config);

// Brings every number that a program has set into the range of its key, so that a file of them can
// be read.
void KeepInRange(Config* config);

// Keys of the VINS family without effect here (vocabulary, output paths, threads, wall-clock
// limits).
const std::vector<std::string>& IgnoredKeys();

}  // namespace plm_vins
