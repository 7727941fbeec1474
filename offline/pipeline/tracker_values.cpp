// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/tracker_values.h"

#include <set>
#include <variant>
#include <vector>

#include "common/config/camera_keys.h"

namespace plm_vins {
namespace {

void AddNames(const ConfigKeys& keys, const std::string& prefix, std::set<std::string>* names) {
  for (const ConfigKey& key : keys) names->insert(prefix + key.name);
}

std::set<std::string> NamesFor(Config config) {
  std::set<std::string> names = {"freq", "use_lines", "num_of_cam", "stereo_pairs", "depth_topic"};
  std::vector<CameraSensor>& cameras = config.sensor.cameras;
  for (size_t i = 0; i < cameras.size(); ++i) {
    CameraParameters* camera = &cameras[i].parameters;
    AddNames(CameraKeys(ModelType(camera->model), camera), CameraPrefix(static_cast<int>(i)),
             &names);
  }
  AddNames(PointTrackerKeys(&config.points), "", &names);
  if (config.use_lines) AddNames(LineTrackerKeys(&config.lines), "", &names);
  return names;
}

}  // namespace

Json TrackerValues(const Config& config) {
  const std::set<std::string> names = NamesFor(config);
  Json values = Json::object();
  for (const auto& [name, value] : EffectiveValues(config)) {
    if (names.count(name) == 0) continue;
    std::visit([&place = values[name]](const auto& v) { place = v; }, value);
  }
  // Normalizes the values to those read back from a file, since a path may not be valid UTF-8.
  return Json::parse(values.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace));
}

// Ignores keys that only one of the two has: they accompany another value that both have and that
// differs. Recorded lines that the configuration disables are no difference: they are dropped on
// request.
Json RecordedOtherwise(const Json& recorded, const Config& config) {
  const Json wanted = TrackerValues(config);
  Json otherwise = Json::object();
  for (const auto& [name, value] : recorded.items()) {
    if (wanted.contains(name) && wanted.at(name) != value) otherwise[name] = value;
  }
  if (!config.use_lines) otherwise.erase("use_lines");
  return otherwise;
}

std::string RecordedOtherwiseWarning(const std::string& file, const Json& otherwise) {
  std::string names;
  for (const auto& [name, value] : otherwise.items()) names += (names.empty() ? "" : ", ") + name;
  return file + " was recorded with other values of " + names +
         ", which its features keep; record it again with --save-features";
}

}  // namespace plm_vins
