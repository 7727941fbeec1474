// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/measurements.h"

namespace plm_vins {

// End of a measurement, which the next one must follow.
struct MeasurementEnd {
  int64_t t_ns = 0;    // image timestamp
  int64_t imu_ns = 0;  // timestamp of the last IMU sample
};

inline MeasurementEnd EndOf(const FrameMeasurement& measurement) {
  return {measurement.t_ns, measurement.imu.back().t_ns};
}

// Throws std::invalid_argument with the reason if a measurement is invalid: its timestamp is not
// after the previous one, its points or lines have another timestamp, an id occurs twice, a feature
// is impossible (common/features/feature_checks.h), or its IMU samples violate the contract of
// FrameMeasurement: ordered by time, finite, and contiguous from the previous measurement to this
// image.
void CheckMeasurement(const FrameMeasurement& measurement,
                      const std::optional<MeasurementEnd>& previous);

}  // namespace plm_vins
