// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "common/config/sensor_config.h"

namespace plm_vins::simulator {

// Adds the sensor's noise to exact depths [m] and rounds them to its unit. Depths that are
// unknown (0) or beyond the sensor's largest become 0. `index` of the image seeds the noise.
cv::Mat1w MeasureDepth(const cv::Mat1f& depth, const DepthSensor& sensor, uint64_t seed,
                       uint64_t index);

}  // namespace plm_vins::simulator
