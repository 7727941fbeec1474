// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/standstill_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/features/common_points.h"
#include "common/median.h"

namespace plm_vins {
namespace {

// Positions and motions of the corners that both images observe [px].
struct CornerMotions {
  std::vector<Eigen::Vector2d> starts, motions;
};

CornerMotions MotionsBetween(const PointFrame& from, const PointFrame& to) {
  CornerMotions result;
  for (const CommonPoint& point : CommonPoints(from, to)) {
    result.starts.push_back(point.first->uv_px);
    result.motions.push_back(point.second->uv_px - point.first->uv_px);
  }
  return result;
}

double MedianDistance(const CornerMotions& corners) {
  std::vector<double> distances;
  for (const Eigen::Vector2d& motion : corners.motions) distances.push_back(motion.norm());
  return Median(distances);
}

// Returns the greatest median of the motions' components: right, down, radial and tangential about
// the mean position.
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

}  // namespace

StandstillDetector::StandstillDetector(const ImuNoise& noise, const Options& options)
    : options_(options), imu_(noise, options.imu) {}

std::optional<StandstillDetector::Standstill> StandstillDetector::Add(
    const FrameMeasurement& measurement) {
  imu_.Add(measurement);
  points_.push_back(measurement.points);
  while (points_.size() > imu_.images()) points_.pop_front();
  if (!imu_.IsQuiet()) return std::nullopt;
  const CornerMotions corners = MotionsBetween(points_.front(), points_.back());
  if (static_cast<int>(corners.motions.size()) < options_.min_points) return std::nullopt;
  if (MedianDistance(corners) > options_.max_motion_px) return std::nullopt;
  return Standstill{imu_.since_ns(), CommonMotion(corners)};
}

void StandstillDetector::Reset() {
  imu_.Reset();
  points_.clear();
}

}  // namespace plm_vins
