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

// Returns whether `fisheye: 1` is set without a mask. VINS-Mono then uses a mask of its own, which
// does not exist here.
bool LacksMask(const ConfigEntries& entries, const Config& config);

// Returns whether a mask is given but disabled by `fisheye: 0`.
bool LeavesMaskOut(const Config& config);

// Returns the percentage of the image without rays, and so without features, because the distortion
// folds back inside the image. Returns 0 if it is negligible, or if a mask is given. Pixels of a
// fisheye at 90 degrees and beyond do not count.
int PercentBeyondFold(const Config& config, const CameraParameters& parameters);

// Converts file values to those of the modules: noise densities, path of the mask.
void FinishConfig(const ConfigEntries& entries, Config* config);

}  // namespace plm_vins
