// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// The values in effect, defaults and overrides included, under the names and in the groups of the
// configuration file; beside them, under "file", its path. Matrices are row-major lists.
Json ToJson(const Config& config);

}  // namespace plm_vins
