// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_comparison.h"

#include <algorithm>
#include <limits>

#include "vins_estimator/geometry/line_fit.h"
#include "vins_estimator/map/line_map.h"

namespace plm_vins {

LineDifference FindDifference(const SameLineLimits& limits, const LinePairGeometry& pair) {
  if (pair.angle > std::max(limits.angle, kLineDeviations * pair.angle_sigma)) {
    return LineDifference::kDirection;
  }
  if (pair.distance > std::max(limits.distance, kLineDeviations * pair.distance_sigma)) {
    return LineDifference::kDistance;
  }
  return pair.gap > limits.distance ? LineDifference::kGap : LineDifference::kNone;
}

// A line that was just marginalized has few observations left, but its position is based on many:
// its standard deviations are set to zero.
std::optional<SeenLine> See(const SlidingWindow& window, const Eigen::Quaterniond& R_F_W,
                            double noise, const LineLandmark& line) {
  constexpr double kGreatestSigma = 0.5;  // [rad], [m]: with more, all lines would be one
  const auto segment = ObservedSegment(line, window);
  if (!segment) return std::nullopt;
  SeenLine seen{R_F_W * segment->start_W, R_F_W * segment->end_W, line.axis};
  if (!HasEnoughObservations(line)) return seen;
  const auto observations = PosedOfHostCamera(line, window);
  const auto fit = EvaluateLine(observations, noise, line.coordinates);
  if (!fit) return std::nullopt;
  const Eigen::Vector3d middle_W = 0.5 * (segment->start_W + segment->end_W);
  const Eigen::Vector3d middle_C0 = observations.front().T_W_C.Inverse() * middle_W;
  seen.direction_sigma = std::min(DirectionDeviation(*fit), kGreatestSigma);
  seen.place_sigma = std::min(PlaceDeviation(*fit, middle_C0), kGreatestSigma);
  return seen;
}

double DistanceInImage(const SlidingWindow& window, const PluckerLine& line_W,
                       const LineLandmark::Observation& observation) {
  const auto distances = DistancesOf(observation, line_W, window);
  return distances ? distances->cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity();
}

}  // namespace plm_vins
