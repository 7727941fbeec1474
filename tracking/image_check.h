// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/camera/camera_model.h"
#include "common/measurements.h"

namespace plm_vins {

// Throws std::invalid_argument if the image is not CV_8UC1, not of the calibrated size, or its
// timestamp is not later than `previous_ns`.
void CheckImage(const ImageSample& image, const CameraParameters& camera,
                const std::optional<int64_t>& previous_ns);

}  // namespace plm_vins
