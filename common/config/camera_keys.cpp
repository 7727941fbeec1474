// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/camera_keys.h"

#include <utility>
#include <vector>

namespace plm_vins {
namespace {

using C = CameraParameters;

// Key names of a camera model's parameters.
struct ModelNames {
  std::string model_type;
  C::Model model;
  std::vector<std::string> projection;  // fx, fy, cx, cy
  std::string distortion_group;
  std::vector<std::string> distortion;
};

const std::vector<ModelNames>& AllModels() {
  static const std::vector<ModelNames> models = {
      {"PINHOLE",
       C::Model::kPinholeRadtan,
       {"fx", "fy", "cx", "cy"},
       "distortion_parameters",
       {"k1", "k2", "p1", "p2"}},
      {"EQUIDISTANT",
       C::Model::kPinholeEquidistant,
       {"fx", "fy", "cx", "cy"},
       "distortion_parameters",
       {"k1", "k2", "k3", "k4"}},
      // Names of VINS-Mono, where k2 to k5 are k1 to k4 of [Kannala2006].
      {"KANNALA_BRANDT",
       C::Model::kPinholeEquidistant,
       {"mu", "mv", "u0", "v0"},
       "projection_parameters",
       {"k2", "k3", "k4", "k5"}},
      {"MEI",
       C::Model::kMei,
       {"gamma1", "gamma2", "u0", "v0"},
       "distortion_parameters",
       {"k1", "k2", "p1", "p2"}}};
  return models;
}

const ModelNames* Find(const std::string& model_type) {
  for (const ModelNames& names : AllModels()) {
    if (names.model_type == model_type) return &names;
  }
  return nullptr;
}

ConfigKey ModelTypeKey(C* camera) {
  std::vector<std::pair<std::string, C::Model>> choices;
  for (const ModelNames& names : AllModels()) choices.emplace_back(names.model_type, names.model);
  return ConfigKey::Choice("model_type", choices, &camera->model);
}

ConfigKeys KeysOf(const ModelNames& names, C* camera) {
  const std::string group = "projection_parameters.";
  ConfigKeys keys = {
      ConfigKey::Number(group + names.projection[0], "px", {1, 1e5}, &camera->fx),
      ConfigKey::Number(group + names.projection[1], "px", {1, 1e5}, &camera->fy),
      ConfigKey::Number(group + names.projection[2], "px", {0, 1e5}, &camera->cx),
      ConfigKey::Number(group + names.projection[3], "px", {0, 1e5}, &camera->cy),
  };
  for (size_t i = 0; i < names.distortion.size(); ++i) {
    keys.push_back(ConfigKey::Number(names.distortion_group + "." + names.distortion[i], "",
                                     {-1e4, 1e4}, &camera->distortion[i]));
  }
  if (names.model == C::Model::kMei) {
    keys.push_back(ConfigKey::Number("mirror_parameters.xi", "", {0, 10}, &camera->xi));
  }
  return keys;
}

}  // namespace

ConfigKeys CameraKeys(const std::string& model_type, CameraParameters* camera) {
  ConfigKeys keys = {
      ModelTypeKey(camera),
      ConfigKey::Integer("image_width", "px", {32, 16384}, &camera->width),
      ConfigKey::Integer("image_height", "px", {32, 16384}, &camera->height),
  };
  if (const ModelNames* names = Find(model_type)) keys = Join({keys, KeysOf(*names, camera)});
  return Required(keys);
}

bool IsModelType(const std::string& model_type) { return Find(model_type) != nullptr; }

std::string ModelType(CameraParameters::Model model) {
  CameraParameters camera;
  camera.model = model;
  return std::get<std::string>(ModelTypeKey(&camera).value());
}

}  // namespace plm_vins
