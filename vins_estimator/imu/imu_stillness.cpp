// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/imu_stillness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plm_vins {
namespace {

// Returns the standard deviation of the axis that varies most.
double LargestDeviation(const std::vector<Eigen::Vector3d>& values) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& value : values) mean += value / static_cast<double>(values.size());
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& value : values) {
    variance += (value - mean).cwiseAbs2() / static_cast<double>(values.size());
  }
  return std::sqrt(variance.maxCoeff());
}

}  // namespace

ImuStillness::ImuStillness(const ImuNoise& noise, const Options& options)
    : noise_(noise), options_(options) {}

void ImuStillness::Add(const FrameMeasurement& measurement) {
  if (measurement.imu.empty()) {
    Reset();
    return;
  }
  Interval interval;
  interval.t_ns = measurement.t_ns;
  for (const ImuSample& sample : measurement.imu) {
    interval.gyro += sample.gyro / static_cast<double>(measurement.imu.size());
    interval.accel += sample.accel / static_cast<double>(measurement.imu.size());
  }
  intervals_.push_back(interval);

  // The front image is the start of the window: the last one that is old enough.
  const int64_t start_ns = measurement.t_ns - ToNanoseconds(options_.window);
  while (HasIntervals(options_.min_intervals + 1) && intervals_[1].t_ns <= start_ns) {
    intervals_.pop_front();
  }
}

double ImuStillness::Duration() const {
  return ToSeconds(intervals_.back().t_ns - intervals_.front().t_ns);
}

bool ImuStillness::HasIntervals(int count) const {
  return static_cast<int>(intervals_.size()) > count;
}

bool ImuStillness::IsKnown() const {
  return HasIntervals(options_.min_intervals) && Duration() >= options_.window &&
         Duration() <= options_.max_window;
}

bool ImuStillness::IsQuiet() const {
  return VariesWithin(options_.min_gyro_deviation, options_.min_accel_deviation);
}

bool ImuStillness::ShowsNoiseAlone() const { return VariesWithin(0, 0); }

bool ImuStillness::VariesWithin(double gyro_deviation, double accel_deviation) const {
  if (!IsKnown()) return false;
  std::vector<Eigen::Vector3d> gyro, accel;
  for (size_t i = 1; i < intervals_.size(); ++i) {
    gyro.push_back(intervals_[i].gyro);
    accel.push_back(intervals_[i].accel);
  }
  // The mean of white noise over an interval has the standard deviation density / sqrt(interval).
  const double interval = Duration() / static_cast<double>(gyro.size());
  const double factor = options_.noise_factor / std::sqrt(interval);
  return LargestDeviation(gyro) <= std::max(factor * noise_.gyro_density, gyro_deviation) &&
         LargestDeviation(accel) <= std::max(factor * noise_.accel_density, accel_deviation);
}

}  // namespace plm_vins
