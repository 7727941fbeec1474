// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// The effective configuration, defaults and overrides included, for reports.
Json ToJson(const Config& config);

}  // namespace plm_vins
