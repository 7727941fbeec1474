// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/config/sensor_config.h"
#include "common/measurements.h"
#include "common/streams/drop_counts.h"

namespace plm_vins {

// Removes what the configuration does not have from received features, and counts it: observations
// of further cameras, which other trackers may send, and depths without a depth sensor.
class FeatureDoor {
 public:
  explicit FeatureDoor(const SensorConfig& sensor);

  void Admit(PointFrame* frame);
  void Admit(LineFrame* frame);

  DropCounts Drops() const;  // only those that are not zero

 private:
  template <typename Observation>
  void RemoveOtherCameras(std::vector<Observation>* observations);

  int cameras_;
  bool has_depth_;
  DropCount of_other_cameras_{"observations_of_other_cameras", 0, ""};
  DropCount depths_{"depths_without_sensor", 0, ""};
};

}  // namespace plm_vins
