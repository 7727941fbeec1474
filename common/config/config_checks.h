// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/config/config.h"
#include "common/config/config_entry.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Reports what is wrong with a key.
using Report = std::function<void(const std::string& key, const std::string& problem)>;

// What is wrong with the name of a frame, nothing where it is fine.
Problem CheckFrameName(const std::string& name);

// Reports values that are fine alone but not together, and keys that others make necessary.
void CheckTogether(const ConfigEntries& entries, const Config& config, const Report& report);

// True where `fisheye: 1` stands without a mask. VINS takes one of its own then, which is not to be
// had here.
bool LacksMask(const ConfigEntries& entries, const Config& config);

// True where a mask is named that `fisheye: 0` switches off.
bool LeavesMaskOut(const Config& config);

// How much of the camera's image has no ray, and so no features, as the distortion folds back
// before its edge; 0 where that is hardly anything, or a mask says where features are. What a
// fisheye sees beside and behind it does not count.
int PercentBeyondFold(const Config& config, const CameraParameters& parameters);

// Turns what is written into what the modules take: noise densities, path of the mask.
void FinishConfig(const ConfigEntries& entries, Config* config);

}  // namespace plm_vins
