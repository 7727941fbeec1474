// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "common/config.h"
#include "common/measurements.h"
#include "vins_estimator/estimator_output.h"

namespace plm_vins {

// Visual-inertial odometry in a sliding window: one call per image, one stage per line of Process().
// Synchronous and deterministic: the same measurements give the same output, bit by bit.
class Estimator {
 public:
  explicit Estimator(const Config& config);
  ~Estimator();

  // Takes the next image's features and IMU samples; stamps must increase.
  EstimatorOutput Process(const FrameMeasurement& measurement);

  // Forgets everything but the configuration and starts over with initialisation.
  void Reset();

  // Time offset td as estimated so far [s]: what MeasurementSync should cut the IMU with.
  double time_offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plm_vins
