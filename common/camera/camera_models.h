// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "common/camera/camera_model.h"

namespace plm_vins {

// The cameras of a rig, by number.
using CameraModels = std::vector<std::shared_ptr<const CameraModel>>;

// `Cameras` are elements with CameraParameters `parameters`, such as those of SensorConfig.
template <typename Cameras>
CameraModels CreateAll(const Cameras& cameras) {
  CameraModels models;
  for (const auto& camera : cameras) models.push_back(CameraModel::Create(camera.parameters));
  return models;
}

}  // namespace plm_vins
