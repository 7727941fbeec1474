// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/config.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// What decides on the features of an image, and is without effect where they are given: the values
// of the camera, of the trackers that are used, and of which images and features are passed on, by
// the names of their keys. (Trackers look ahead with the gyro by a few keys more, of the rig; these
// do not go without effect, as the estimator follows them.)
Json TrackerValues(const Config& config);

// Of the values by which features were recorded, those that `config` has otherwise.
Json RecordedOtherwise(const Json& recorded, const Config& config);

// What there is to say of these.
std::string RecordedOtherwiseWarning(const std::string& file, const Json& otherwise);

}  // namespace plm_vins
