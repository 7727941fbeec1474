// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/measurement_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/features/feature_checks.h"

namespace plm_vins {
namespace {

[[noreturn]] void Reject(const FrameMeasurement& measurement, const std::string& why) {
  throw std::invalid_argument("image of " + std::to_string(measurement.t_ns) + " ns: " + why);
}

template <typename Observation>
void CheckFeatures(const FrameMeasurement& measurement, int64_t t_ns,
                   const std::vector<Observation>& observations, const std::string& kind) {
  if (t_ns != measurement.t_ns) {
    Reject(measurement, "its " + kind + "s have the timestamp " + std::to_string(t_ns) + " ns");
  }
  std::vector<int64_t> tracks;
  tracks.reserve(observations.size());
  for (const Observation& observation : observations) {
    if (!IsPossible(observation)) {
      Reject(measurement,
             kind + " " + std::to_string(observation.id) + " has impossible coordinates");
    }
    tracks.push_back(TrackKey(observation));
  }
  std::sort(tracks.begin(), tracks.end());
  const auto twice = std::adjacent_find(tracks.begin(), tracks.end());
  if (twice != tracks.end()) {
    Reject(measurement, kind + " " + std::to_string(*twice / kMaxCameras) + " occurs twice");
  }
}

bool IsDoubt(double deviation) { return std::isfinite(deviation) && deviation >= 0; }

bool IsFinite(const ImuSample& sample) {
  return sample.gyro.allFinite() && sample.accel.allFinite() && IsDoubt(sample.gyro_doubt) &&
         IsDoubt(sample.accel_doubt);
}

bool Increase(const std::vector<ImuSample>& samples) {
  const auto is_not_before = [](const ImuSample& a, const ImuSample& b) {
    return a.t_ns >= b.t_ns;
  };
  return std::adjacent_find(samples.begin(), samples.end(), is_not_before) == samples.end();
}

void CheckImu(const FrameMeasurement& measurement, const std::optional<MeasurementEnd>& previous) {
  const std::vector<ImuSample>& imu = measurement.imu;
  if (imu.empty()) Reject(measurement, "it has no IMU sample");
  if (!std::all_of(imu.begin(), imu.end(), IsFinite)) {
    Reject(measurement, "an IMU sample is not finite, or its doubt negative");
  }
  if (!Increase(imu)) Reject(measurement, "the stamps of its IMU samples do not increase");
  if (!previous) return;
  if (imu.front().t_ns != previous->imu_ns) {
    Reject(measurement, "its IMU samples do not begin at the end of the previous ones, " +
                            std::to_string(previous->imu_ns) + " ns");
  }
  if (imu.size() < 2) Reject(measurement, "no IMU sample follows the previous image");
}

}  // namespace

void CheckMeasurement(const FrameMeasurement& measurement,
                      const std::optional<MeasurementEnd>& previous) {
  if (previous && measurement.t_ns <= previous->t_ns) {
    Reject(measurement,
           "it is not after the previous image, " + std::to_string(previous->t_ns) + " ns");
  }
  CheckFeatures(measurement, measurement.points.t_ns, measurement.points.points, "point");
  if (measurement.lines) {
    CheckFeatures(measurement, measurement.lines->t_ns, measurement.lines->lines, "line");
  }
  CheckImu(measurement, previous);
}

}  // namespace plm_vins
