// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/config/config.h"
#include "common/config/config_entry.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Reports a problem of a key.
using Report = std::function<void(const std::string& key, const std::string& problem)>;

// Returns what is wrong with a frame name; nullopt if it is valid.
Problem CheckFrameName(const std::string& name);

// Reports values that are valid alone but contradict each other, and keys that other keys require.
void CheckTogether(const ConfigEntries& entries, const Config& config, const Report& report);

// Reports valid values that probably are a mistake.
void CheckIntention(const ConfigEntries& entries, const Config& config, const Report& report);

// Converts file values to those of the modules: noise densities, path of the mask.
void FinishConfig(const ConfigEntries& entries, Config* config);

}  // namespace plm_vins
