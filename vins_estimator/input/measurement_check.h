// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// Where a measurement ends, for the next one to follow.
struct MeasurementEnd {
  int64_t t_ns = 0;    // of the image
  int64_t imu_ns = 0;  // of the last IMU sample
};

inline MeasurementEnd EndOf(const FrameMeasurement& measurement) {
  return {measurement.t_ns, measurement.imu.back().t_ns};
}

// Throws std::invalid_argument, which says why, where the estimator must not take a measurement:
// its stamp is not after that of the one before, its points or lines are of another image, an id is
// there twice, a feature is impossible (common/features/feature_checks.h), or its IMU samples are
// not what FrameMeasurement says: in order of time, finite, and from those before to this image.
void CheckMeasurement(const FrameMeasurement& measurement,
                      const std::optional<MeasurementEnd>& previous);

}  // namespace plm_vins
