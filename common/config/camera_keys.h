// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/camera/camera_model.h"
#include "common/config/config_key.h"

namespace plm_vins {

// Returns the calibration keys of this `model_type`, all required. If the type is unknown, the keys
// of the model's parameters are missing.
ConfigKeys CameraKeys(const std::string& model_type, CameraParameters* camera);

// Returns whether `model_type` is supported.
bool IsModelType(const std::string& model_type);

// Returns the `model_type` of a model. A fisheye is always EQUIDISTANT, even if the file uses the
// alternative name KANNALA_BRANDT.
std::string ModelType(CameraParameters::Model model);

}  // namespace plm_vins
