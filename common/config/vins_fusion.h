// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/config_entry.h"

namespace plm_vins {

// Returns the number of cameras in `num_of_cam`; 1 if it is missing or not a number.
int CameraCount(const ConfigEntries& entries);

// Replaces the keys that only VINS-Fusion has by equivalent ones: image0_topic, body_T_cam0, and
// the calibrations in the files cam0_calib, cam1_calib, ..., relative to the configuration `file`.
// Adds keys that have no effect to `ignored`, among them those of cameras beyond num_of_cam. Adds
// to `problems` an unreadable camera file, a camera without keys, contradictory values, and
// odometry without an IMU. Returns false if the keys of a camera are unknown.
bool ReplaceVinsFusionKeys(const std::string& file, ConfigEntries* entries,
                           std::vector<std::string>* ignored, std::vector<std::string>* problems);

}  // namespace plm_vins
