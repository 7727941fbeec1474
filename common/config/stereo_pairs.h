// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config_key.h"
#include "common/config/sensor_config.h"

namespace plm_vins {

// Two cameras that show mostly the same. Features of the first one are matched in the second one,
// which has no tracker of its own. A camera belongs to at most one pair.
struct StereoPair {
  int first = 0;
  int second = 1;
};

// Returns the pairs of the cameras. The key stereo_pairs names them, such as "0-1 2-3"; "auto"
// pairs cameras of which the first one shows more than half of the distant points of the second
// one.
std::vector<StereoPair> StereoPairs(const SensorConfig& sensor);

// Returns whether the camera is tracked on its own: it is not the second one of a pair.
bool IsTracked(int camera, const std::vector<StereoPair>& pairs);

// Returns what is wrong with the key stereo_pairs.
Problem CheckStereoPairs(const SensorConfig& sensor);

}  // namespace plm_vins
