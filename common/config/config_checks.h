// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/config/config_entry.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Reports what is wrong with a key.
using Report = std::function<void(const std::string& key, const std::string& problem)>;

// Reports values that are fine alone but not together, and keys that others make necessary.
void CheckTogether(const ConfigEntries& entries, const ConfigDraft& draft, const Report& report);

// Turns what is written into what the modules take: camera model, noise densities, path of the
// mask.
Config FinishConfig(const ConfigEntries& entries, const ConfigDraft& draft);

}  // namespace plm_vins
