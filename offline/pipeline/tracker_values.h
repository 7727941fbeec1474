// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// Returns the configuration values that determine the features and have no effect if features are
// given: those of the camera, of the trackers in use, and of the selection of images and features,
// by key. (Extrinsics and a few more keys affect where the trackers search; these still have
// an effect, since the estimator uses them.)
Json TrackerValues(const Config& config);

// Returns those values the features were recorded with that differ from the values of `config`.
Json RecordedOtherwise(const Json& recorded, const Config& config);

// Formats the warning about these differences.
std::string RecordedOtherwiseWarning(const std::string& file, const Json& otherwise);

}  // namespace plm_vins
