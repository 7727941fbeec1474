// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

namespace plm_vins {

// JSON whose objects keep insertion order; alphabetical with library versions before 3.9 (Ubuntu
// 20.04), which offer nothing else.
#if NLOHMANN_JSON_VERSION_MAJOR > 3 || \
    (NLOHMANN_JSON_VERSION_MAJOR == 3 && NLOHMANN_JSON_VERSION_MINOR >= 9)
using Json = nlohmann::ordered_json;
#else
using Json = nlohmann::json;
#endif

}  // namespace plm_vins
