// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

namespace plm_vins {

// JSON whose objects keep the order in which they were filled; in alphabetical order where the
// library (before 3.9, as in Ubuntu 20.04) has nothing else.
#if NLOHMANN_JSON_VERSION_MAJOR > 3 || \
    (NLOHMANN_JSON_VERSION_MAJOR == 3 && NLOHMANN_JSON_VERSION_MINOR >= 9)
using Json = nlohmann::ordered_json;
#else
using Json = nlohmann::json;
#endif

}  // namespace plm_vins
