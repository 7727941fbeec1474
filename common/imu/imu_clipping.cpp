// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_clipping.h"

#include <algorithm>
#include <cmath>

namespace plm_vins {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The smallest ranges of sensors are 125 deg/s and 2 g. Smaller readings may recur for other
// reasons, as in a simulation without noise.
constexpr ImuRange kLeastRange = {2.0, 18.0};

constexpr int64_t kMinClipped = 20;  // readings

// Readings are near the largest one within this share of it. At the peaks of a sine, with a
// resolution of a third of that, 1.4 times as many readings equal the largest one as are near it;
// with noise or a finer resolution fewer do.
constexpr double kNear = 0.05;
constexpr int64_t kMinRatio = 2;
constexpr double kMinLevels = 3;

// Least limit of an axis relative to the largest reading of all axes, which have the same range up
// to errors of scale and bias.
constexpr double kSameRange = 0.9;

}  // namespace

void ImuClipping::Add(const ImuSample& sample) {
  const ImuSample last = newest_.value_or(sample);
  newest_ = sample;
  if (last.gyro != sample.gyro) {
    for (int i = 0; i < 3; ++i) gyro_[i].Add(last.gyro[i], sample.gyro[i]);
  }
  if (last.accel != sample.accel) {
    for (int i = 0; i < 3; ++i) accel_[i].Add(last.accel[i], sample.accel[i]);
  }
}

ImuRange ImuClipping::Range(const ImuRange& configured) const {
  return {std::min(configured.gyro, Limit(gyro_, kLeastRange.gyro)),
          std::min(configured.accel, Limit(accel_, kLeastRange.accel))};
}

double ImuClipping::Limit(const Axes& axes, double least) {
  double largest = 0, limit = kUnlimited;
  for (const Axis& axis : axes) {
    largest = std::max(largest, axis.Largest());
    limit = std::min(limit, axis.Limit());
  }
  return limit < std::max(least, kSameRange * largest) ? kUnlimited : limit;
}

void ImuClipping::End::Add(double reading) {
  if (reading > largest) {
    *this = {reading, 1, 0};
  } else if (reading == largest) {
    ++at_largest;
  } else if (reading > (1 - kNear) * largest) {
    ++near_it;
  }
}

bool ImuClipping::End::IsClipped() const {
  return at_largest >= kMinClipped && at_largest > kMinRatio * near_it;
}

void ImuClipping::Axis::Add(double last, double reading) {
  if (last != reading) least_change = std::min(least_change, std::abs(reading - last));
  ends[reading > 0 ? 0 : 1].Add(std::abs(reading));
}

double ImuClipping::Axis::Largest() const { return std::max(ends[0].largest, ends[1].largest); }

double ImuClipping::Axis::Limit() const {
  double limit = kUnlimited;
  for (const End& end : ends) {
    const bool is_resolved = kMinLevels * least_change <= kNear * end.largest;
    if (is_resolved && end.IsClipped()) limit = std::min(limit, end.largest);
  }
  return limit;
}

}  // namespace plm_vins
