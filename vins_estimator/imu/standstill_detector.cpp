// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/standstill_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "common/features/common_points.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

// While the scene moves, the IMU alone confirms the standstill, whose biases drift [s].
constexpr double kFollowing = 2;

// Positions and motions of the corners that a camera observes in both frames [px].
struct CornerMotions {
  std::vector<Eigen::Vector2d> starts, motions;
  std::vector<Eigen::Vector2d> ray_motions;  // normalized
};

CornerMotions MotionsBetween(const PointFrame& from, const PointFrame& to) {
  CornerMotions result;
  for (const CommonPoint& point : CommonPointsOfOneCamera(from, to)) {
    result.starts.push_back(point.first->uv_px);
    result.motions.push_back(point.second->uv_px - point.first->uv_px);
    result.ray_motions.push_back(point.second->xy - point.first->xy);
  }
  return result;
}

double MedianDistance(const std::vector<Eigen::Vector2d>& motions) {
  std::vector<double> distances;
  distances.reserve(motions.size());
  for (const Eigen::Vector2d& motion : motions) distances.push_back(motion.norm());
  return Median(distances);
}

// Median of values, and what the noise of single values may add to it.
struct NoisyMedian {
  double size, noise;
  double Significant() const { return size > noise ? size : 0; }
};

NoisyMedian MedianOf(const std::vector<double>& values) {
  constexpr double kSigmas = 3;
  const double median = Median(values);
  std::vector<double> distances(values.size());
  for (size_t i = 0; i < values.size(); ++i) distances[i] = std::abs(values[i] - median);
  // Standard deviation of the median of normally distributed values with this median distance.
  const double deviation =
      1.253 * 1.483 * Median(std::move(distances)) / std::sqrt(static_cast<double>(values.size()));
  return {std::abs(median), kSigmas * deviation};
}

// Returns the medians of the motions' components: right, down, radial and tangential about the mean
// position.
std::array<NoisyMedian, 4> CommonMotions(const std::vector<Eigen::Vector2d>& starts,
                                         const std::vector<Eigen::Vector2d>& motions) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& start : starts) {
    middle += start / static_cast<double>(starts.size());
  }
  std::array<std::vector<double>, 4> components;
  for (size_t i = 0; i < motions.size(); ++i) {
    const Eigen::Vector2d& motion = motions[i];
    const Eigen::Vector2d outwards = (starts[i] - middle).normalized();
    components[0].push_back(motion.x());
    components[1].push_back(motion.y());
    components[2].push_back(outwards.dot(motion));
    components[3].push_back(outwards.x() * motion.y() - outwards.y() * motion.x());
  }
  return {MedianOf(components[0]), MedianOf(components[1]), MedianOf(components[2]),
          MedianOf(components[3])};
}

// Returns the greatest significant common motion [px].
double CommonMotion(const CornerMotions& corners) {
  double greatest = 0;
  for (const NoisyMedian& median : CommonMotions(corners.starts, corners.motions)) {
    greatest = std::max(greatest, median.Significant());
  }
  return greatest;
}

// Returns the greatest common motion that the corners may have, as a ray.
double GreatestRayMotion(const CornerMotions& corners) {
  double greatest = 0;
  for (const NoisyMedian& median : CommonMotions(corners.starts, corners.ray_motions)) {
    greatest = std::max(greatest, median.size + median.noise);
  }
  return greatest;
}

}  // namespace

StandstillDetector::StandstillDetector(const ImuNoise& noise, const Options& options)
    : options_(options), imu_(noise, options.imu), confirmed_(noise) {}

std::optional<StandstillDetector::Standstill> StandstillDetector::Add(
    const FrameMeasurement& measurement, std::optional<double> depth) {
  imu_.Add(measurement);
  confirmed_.Add(measurement);
  points_.push_back(measurement.points);
  felt_positions_.push_back(unseen_.position());
  while (points_.size() > imu_.images()) {
    points_.pop_front();
    felt_positions_.pop_front();
  }
  doubts_camera_ = sees_unfelt_motion_ = false;
  if (points_.empty()) {
    confirmed_.Reset();
    unseen_.Reset();
    return std::nullopt;
  }
  const CornerMotions corners = MotionsBetween(points_.front(), points_.back());
  const bool sees = static_cast<int>(corners.motions.size()) >= options_.min_points;
  const bool rests = sees && MedianDistance(corners.motions) <= options_.max_motion_px;
  if (rests) {
    unseen_.Add(measurement.imu, imu_.IsQuiet());
    felt_positions_.back() = unseen_.position();
  } else if (sees) {
    unseen_.Reset();
  }
  if (rests && unseen_.IsFelt() && IsUnseen(GreatestRayMotion(corners), depth)) {
    return Standstill{confirmed_ns_, CommonMotion(corners), false, true};
  }
  if (!imu_.IsQuiet()) {
    confirmed_.Reset();
    return std::nullopt;
  }
  if (rests) {
    confirmed_.Confirm();
    seen_ = Seen::kStandstill;
    confirmed_ns_ = measurement.t_ns;
    return Standstill{imu_.since_ns(), CommonMotion(corners)};
  }
  sees_unfelt_motion_ = sees && imu_.ShowsNoiseAlone();
  if (!confirmed_.Continues()) {
    confirmed_.Reset();
    return std::nullopt;
  }
  if (sees && seen_ != Seen::kMovingScene) {
    const bool is_of_scene = IsOfScene(MedianDistance(corners.ray_motions), depth);
    seen_ = is_of_scene ? Seen::kMovingScene : Seen::kMotion;
  }
  if (seen_ == Seen::kMotion) {
    const bool may_stand = sees_unfelt_motion_ || confirmed_.TimeSince() < options_.max_doubt;
    doubts_camera_ = !depth && may_stand;
    return std::nullopt;
  }
  const Standstill standstill{confirmed_ns_, 0, seen_ == Seen::kMovingScene};
  if (standstill.scene_moves && confirmed_.TimeSince() > kFollowing) {
    confirmed_.Confirm();
    confirmed_ns_ = measurement.t_ns;
  }
  return standstill;
}

// Tests translation only, because the IMU measures rotations at once.
bool StandstillDetector::IsOfScene(double motion, std::optional<double> depth) const {
  constexpr double kNearest = 0.3;  // [m], of an unknown scene
  const double duration = ToSeconds(points_.back().t_ns - points_.front().t_ns);
  return motion > confirmed_.UnnoticedVelocity() * duration / depth.value_or(kNearest);
}

bool StandstillDetector::IsUnseen(double greatest_motion, std::optional<double> depth) const {
  constexpr double kFar = 50;     // [m], of an unknown scene
  constexpr double kFarther = 4;  // factor on the depth, which may be of other points
  const double felt = (felt_positions_.back() - felt_positions_.front()).norm();
  return greatest_motion < felt / (kFarther * depth.value_or(kFar));
}

void StandstillDetector::Reset() {
  imu_.Reset();
  doubts_camera_ = sees_unfelt_motion_ = false;
  confirmed_.Reset();
  unseen_.Reset();
  points_.clear();
  felt_positions_.clear();
}

}  // namespace plm_vins
