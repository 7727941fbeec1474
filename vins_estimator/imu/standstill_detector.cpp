// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/standstill_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "common/median.h"

namespace plm_vins {
namespace {

// From where to where the corners moved that both images show [px].
struct CornerMotions {
  std::vector<Eigen::Vector2d> starts, motions;
};

CornerMotions MotionsBetween(const PointFrame& from, const PointFrame& to) {
  std::unordered_map<int64_t, Eigen::Vector2d> start;
  for (const PointObservation& point : from.points) start.emplace(point.id, point.uv_px);
  CornerMotions result;
  for (const PointObservation& point : to.points) {
    const auto found = start.find(point.id);
    if (found == start.end()) continue;
    result.starts.push_back(found->second);
    result.motions.push_back(point.uv_px - found->second);
  }
  return result;
}

double MedianDistance(const CornerMotions& corners) {
  std::vector<double> distances;
  for (const Eigen::Vector2d& motion : corners.motions) distances.push_back(motion.norm());
  return Median(distances);
}

// The greatest median of the motions' components to the right, down, outwards and about the middle.
double CommonMotion(const CornerMotions& corners) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& start : corners.starts) {
    middle += start / static_cast<double>(corners.starts.size());
  }
  std::array<std::vector<double>, 4> components;
  for (size_t i = 0; i < corners.motions.size(); ++i) {
    const Eigen::Vector2d& motion = corners.motions[i];
    const Eigen::Vector2d outwards = (corners.starts[i] - middle).normalized();
    components[0].push_back(motion.x());
    components[1].push_back(motion.y());
    components[2].push_back(outwards.dot(motion));
    components[3].push_back(outwards.x() * motion.y() - outwards.y() * motion.x());
  }
  double greatest = 0;
  for (const auto& values : components) greatest = std::max(greatest, std::abs(Median(values)));
  return greatest;
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

std::optional<StandstillDetector::Standstill> StandstillDetector::Add(
    const FrameMeasurement& measurement) {
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
  while (HasIntervals(options_.min_intervals + 1) && intervals_[1].t_ns <= start_ns) {
    intervals_.pop_front();
  }
  if (!IsFull() || !ImuIsQuiet()) return std::nullopt;
  const CornerMotions corners = MotionsBetween(intervals_.front().points, intervals_.back().points);
  if (static_cast<int>(corners.motions.size()) < options_.min_points) return std::nullopt;
  if (MedianDistance(corners) > options_.max_motion_px) return std::nullopt;
  return Standstill{intervals_.front().t_ns, CommonMotion(corners)};
}

double StandstillDetector::Duration() const {
  return ToSeconds(intervals_.back().t_ns - intervals_.front().t_ns);
}

bool StandstillDetector::HasIntervals(int count) const {
  return static_cast<int>(intervals_.size()) > count;
}

bool StandstillDetector::IsFull() const {
  return HasIntervals(options_.min_intervals) && Duration() >= options_.window &&
         Duration() <= options_.max_window;
}

bool StandstillDetector::ImuIsQuiet() const {
  std::vector<Eigen::Vector3d> gyro, accel;
  for (size_t i = 1; i < intervals_.size(); ++i) {
    gyro.push_back(intervals_[i].gyro);
    accel.push_back(intervals_[i].accel);
  }
  // An average of white noise over an interval deviates by density / sqrt(interval).
  const double interval = Duration() / static_cast<double>(gyro.size());
  const double factor = options_.noise_factor / std::sqrt(interval);
  return LargestDeviation(gyro) <=
             std::max(factor * noise_.gyro_density, options_.min_gyro_deviation) &&
         LargestDeviation(accel) <=
             std::max(factor * noise_.accel_density, options_.min_accel_deviation);
}

}  // namespace plm_vins
