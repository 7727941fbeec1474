// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/measurement_check.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/feature_checks.h"

namespace plm_vins {
namespace {

[[noreturn]] void Refuse(const FrameMeasurement& measurement, const std::string& why) {
  throw std::invalid_argument("image of " + std::to_string(measurement.t_ns) + " ns: " + why);
}

template <typename Observation>
void CheckFeatures(const FrameMeasurement& measurement, int64_t t_ns,
                   const std::vector<Observation>& observations, const std::string& kind) {
  if (t_ns != measurement.t_ns) {
    Refuse(measurement, "its " + kind + "s are of " + std::to_string(t_ns) + " ns");
  }
  std::vector<int64_t> ids;
  ids.reserve(observations.size());
  for (const Observation& observation : observations) {
    if (!IsPossible(observation)) {
      Refuse(measurement, kind + " " + std::to_string(observation.id) + " is nowhere in an image");
    }
    ids.push_back(observation.id);
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) {
    Refuse(measurement, kind + " " + std::to_string(*twice) + " is there twice");
  }
}

}  // namespace

void CheckMeasurement(const FrameMeasurement& measurement,
                      const std::optional<int64_t>& previous_ns) {
  if (previous_ns && measurement.t_ns <= *previous_ns) {
    Refuse(measurement, "it is not after the one before, of " + std::to_string(*previous_ns));
  }
  CheckFeatures(measurement, measurement.points.t_ns, measurement.points.points, "point");
  if (measurement.lines) {
    CheckFeatures(measurement, measurement.lines->t_ns, measurement.lines->lines, "line");
  }
  const bool finite = std::all_of(
      measurement.imu.begin(), measurement.imu.end(),
      [](const ImuSample& sample) { return sample.gyro.allFinite() && sample.accel.allFinite(); });
  if (!finite) Refuse(measurement, "an IMU sample is not finite");
}

}  // namespace plm_vins
