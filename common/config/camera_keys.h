// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/camera/camera_model.h"
#include "common/config/config_key.h"

namespace plm_vins {

// The calibration of a camera under the names that go with this `model_type`; without those of the
// model where there is no such type. All are required.
ConfigKeys<CameraParameters> CameraKeys(const std::string& model_type);

// Whether there is such a `model_type`.
bool IsModelType(const std::string& model_type);

// The `model_type` of a model. A fisheye is EQUIDISTANT, even where the file uses its other name,
// which is KANNALA_BRANDT.
std::string ModelType(CameraParameters::Model model);

}  // namespace plm_vins
