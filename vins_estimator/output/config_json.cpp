// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/config_json.h"

#include <string>
#include <variant>

namespace plm_vins {

Json ToJson(const Config& config) {
  Json json = {{"file", config.file}};
  for (const auto& [name, value] : EffectiveValues(config)) {
    const size_t dot = name.find('.');
    Json& place =
        dot == std::string::npos ? json[name] : json[name.substr(0, dot)][name.substr(dot + 1)];
    std::visit([&place](const auto& v) { place = v; }, value);
  }
  return json;
}

}  // namespace plm_vins
