// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// Returns the effective values, including defaults and overrides, in the groups and under the names
// of the configuration file, and its path under "file". Matrices are row-major lists.
Json ToJson(const Config& config);

}  // namespace plm_vins
