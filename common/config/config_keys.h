// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/config/config_key.h"

namespace plm_vins {

// The key that decides which camera keys there are.
ConfigKey ModelTypeKey();

// Every key but those of the camera model. To add a key, add a line to its group in
// config_keys.cpp and one to config/reference.yaml.
std::vector<ConfigKey> GeneralKeys();

// The calibration keys of one camera model, all required.
std::vector<ConfigKey> CameraKeys(ConfigDraft::ModelType type);

// Keys of the VINS family that have no meaning here (loop closure, output paths, wall-clock
// limits).
const std::vector<std::string>& IgnoredKeys();

}  // namespace plm_vins
