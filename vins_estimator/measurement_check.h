// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Throws std::invalid_argument, which says why, where the estimator must not take a measurement:
// its stamp is not after that of the one before, its points or lines are of another image, an id is
// there twice, a feature is impossible (common/feature_checks.h), or an IMU sample is not finite.
void CheckMeasurement(const FrameMeasurement& measurement,
                      const std::optional<int64_t>& previous_ns);

}  // namespace plm_vins
