// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "common/config.h"

namespace plm_vins {

// The effective configuration, defaults and overrides included, for reports.
nlohmann::ordered_json ToJson(const Config& config);

}  // namespace plm_vins
