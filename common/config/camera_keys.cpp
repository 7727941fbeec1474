// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/camera_keys.h"

#include <utility>
#include <vector>

namespace plm_vins {
namespace {

using C = CameraParameters;
using CameraKey = ConfigKey<C>;

// CameraKey names of a camera model's parameters.
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

CameraKey ModelTypeKey() {
  std::vector<std::pair<std::string, C::Model>> choices;
  for (const ModelNames& names : AllModels()) choices.emplace_back(names.model_type, names.model);
  return CameraKey::Choice("model_type", choices, &C::model);
}

ConfigKeys<C> KeysOf(const ModelNames& names) {
  const std::string group = "projection_parameters.";
  ConfigKeys<C> keys = {
      CameraKey::Number(group + names.projection[0], "px", {1, 1e5}, &C::fx),
      CameraKey::Number(group + names.projection[1], "px", {1, 1e5}, &C::fy),
      CameraKey::Number(group + names.projection[2], "px", {0, 1e5}, &C::cx),
      CameraKey::Number(group + names.projection[3], "px", {0, 1e5}, &C::cy),
  };
  for (size_t i = 0; i < names.distortion.size(); ++i) {
    const auto coefficient = [i](auto& camera) -> auto& { return camera.distortion[i]; };
    keys.push_back(CameraKey::Number(names.distortion_group + "." + names.distortion[i], "",
                                     {-1e4, 1e4}, coefficient));
  }
  if (names.model == C::Model::kMei) {
    keys.push_back(CameraKey::Number("mirror_parameters.xi", "", {0, 10}, &C::xi));
  }
  return keys;
}

}  // namespace

ConfigKeys<CameraParameters> CameraKeys(const std::string& model_type) {
  ConfigKeys<C> keys = {
      ModelTypeKey(),
      CameraKey::Integer("image_width", "px", {32, 16384}, &C::width),
      CameraKey::Integer("image_height", "px", {32, 16384}, &C::height),
  };
  if (const ModelNames* names = Find(model_type)) keys = Join<C>({keys, KeysOf(*names)});
  return Required(keys);
}

bool IsModelType(const std::string& model_type) { return Find(model_type) != nullptr; }

std::string ModelType(CameraParameters::Model model) {
  CameraParameters camera;
  camera.model = model;
  return std::get<std::string>(ModelTypeKey().value(camera));
}

}  // namespace plm_vins
