// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/imu/imu_sensor.h"
#include "common/measurements.h"

namespace plm_vins {

// Finds the ranges of the sensors from their readings, since drivers rarely state them. Readings
// beyond the range are clipped to its end, so the largest reading of an axis recurs exactly;
// without clipping, fewer readings equal the largest one than come close to it, even during
// vibration. Samples that a driver repeats are counted once.
class ImuClipping {
 public:
  void Add(const ImuSample& sample);

  // Returns the ranges: those configured, or less where readings are clipped below.
  ImuRange Range(const ImuRange& configured) const;

 private:
  // Readings of one axis in one direction.
  struct End {
    double largest = 0;
    int64_t at_largest = 0;  // number of readings equal to the largest one
    int64_t near_it = 0;     // number of smaller ones that are close to it, since it occurred

    void Add(double reading);
    bool IsClipped() const;
  };

  // Readings of one axis.
  struct Axis {
    std::array<End, 2> ends;  // of positive and negative readings
    double least_change = std::numeric_limits<double>::infinity();  // resolution of the readings

    void Add(double last, double reading);
    double Largest() const;
    // Returns the reading at which the axis is clipped, or infinity.
    double Limit() const;
  };
  using Axes = std::array<Axis, 3>;

  // Returns the reading at which axes are clipped, at least `least`, or infinity.
  static double Limit(const Axes& axes, double least);

  Axes gyro_, accel_;
  std::optional<ImuSample> newest_;
};

}  // namespace plm_vins
