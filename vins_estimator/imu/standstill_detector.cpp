// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/standstill_detector.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "common/median.h"

namespace plm_vins {
namespace {

// Distances in pixels between the corners that both images show.
std::vector<double> CornerMotions(const PointFrame& from, const PointFrame& to) {
  std::unordered_map<int64_t, Eigen::Vector2d> start;
  for (const PointObservation& point : from.points) start.emplace(point.id, point.uv_px);
  std::vector<double> motions;
  for (const PointObservation& point : to.points) {
    const auto found = start.find(point.id);
    if (found != start.end()) motions.push_back((point.uv_px - found->second).norm());
  }
  return motions;
}

// Standard deviation of the axis that varies most.
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

StandstillDetector::StandstillDetector(const ImuNoise& noise, const Options& options)
    : noise_(noise), options_(options) {}

std::optional<int64_t> StandstillDetector::Add(const FrameMeasurement& measurement) {
  if (measurement.imu.empty()) {
    Reset();
    return std::nullopt;
  }
  Interval interval;
  interval.t_ns = measurement.t_ns;
  interval.points = measurement.points;
  for (const ImuSample& sample : measurement.imu) {
    interval.gyro += sample.gyro / static_cast<double>(measurement.imu.size());
    interval.accel += sample.accel / static_cast<double>(measurement.imu.size());
  }
  intervals_.push_back(std::move(interval));

  // The front image opens the window: the last one that is old enough.
  const int64_t start_ns = measurement.t_ns - ToNanoseconds(options_.window);
  while (intervals_.size() > 1 && intervals_[1].t_ns <= start_ns) intervals_.pop_front();
  const bool full = intervals_.front().t_ns <= start_ns &&
                    static_cast<int>(intervals_.size()) > options_.min_intervals;
  if (!full || !ImuIsQuiet() || !PointsStay()) return std::nullopt;
  return intervals_.front().t_ns;
}

bool StandstillDetector::ImuIsQuiet() const {
  std::vector<Eigen::Vector3d> gyro, accel;
  for (size_t i = 1; i < intervals_.size(); ++i) {
    gyro.push_back(intervals_[i].gyro);
    accel.push_back(intervals_[i].accel);
  }
  // An average of white noise over an interval deviates by density / sqrt(interval).
  const double window = ToSeconds(intervals_.back().t_ns - intervals_.front().t_ns);
  const double interval = window / static_cast<double>(gyro.size());
  const double factor = options_.noise_factor / std::sqrt(interval);
  return LargestDeviation(gyro) <=
             std::max(factor * noise_.gyro_density, options_.min_gyro_deviation) &&
         LargestDeviation(accel) <=
             std::max(factor * noise_.accel_density, options_.min_accel_deviation);
}

bool StandstillDetector::PointsStay() const {
  const std::vector<double> motions =
      CornerMotions(intervals_.front().points, intervals_.back().points);
  return static_cast<int>(motions.size()) >= options_.min_points &&
         Median(motions) <= options_.max_motion_px;
}

}  // namespace plm_vins
