// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace plm_vins {
namespace {

constexpr int kMinMeasurementsToTriangulate = 3;
constexpr double kMaxNoiseRatio =
    2.0;                               // largest stated noise of a segment, over the noise of lines
constexpr double kMinSegment = 1e-3;   // normalized
constexpr double kMinDistance = 1e-6;  // distance of a line from its host's camera [m]

PosedLineObservation Posed(const LineLandmark::Observation& observation,
                           const SlidingWindow& window) {
  return {window.T_W_C(observation), observation.segment};
}

LineTriangulationResult TriangulateLandmark(const SlidingWindow& window,
                                            const LineTriangulationOptions& options,
                                            LineLandmark* landmark) {
  std::vector<PosedLineObservation> observations;
  observations.reserve(landmark->observations.size());
  for (const LineLandmark::Observation& observation : landmark->observations) {
    if (observation.deviation.maxCoeff() >= kMaxNoiseRatio * options.noise) continue;
    observations.push_back(Posed(observation, window));
  }
  const TriangulatedLine triangulated = TriangulateLine(options, observations);
  landmark->triangulated = triangulated.result == LineTriangulationResult::kOk;
  if (landmark->triangulated) landmark->coordinates = triangulated.line;
  return triangulated.result;
}

void Count(LineTriangulationResult result, LineTriangulationCounts* counts) {
  counts->triangulated += result == LineTriangulationResult::kOk;
  counts->degenerate += result == LineTriangulationResult::kDegenerate;
  counts->behind += result == LineTriangulationResult::kBehind;
  counts->inconsistent += result == LineTriangulationResult::kInconsistent;
  counts->too_long += result == LineTriangulationResult::kTooLong;
}

double Length(const MapLine& line) { return (line.end_W - line.start_W).norm(); }

bool IsTooLong(const LineLandmark& landmark, const SlidingWindow& window, double max_length) {
  const auto segment = ObservedSegment(landmark, window);
  return segment && Length(*segment) > max_length;
}

// Returns the mean square of the two residuals in units of the noise; infinite without projection.
double MeanSquareError(const PluckerLine& line_W, const LineLandmark::Observation& observation,
                       double noise, const SlidingWindow& window) {
  const auto distances = DistancesOf(observation, line_W, window);
  if (!distances) return std::numeric_limits<double>::infinity();
  return 0.5 * distances->squaredNorm() / (noise * noise);
}

// Removes outliers among the observations in anchors. Returns the number of removed observations.
int RemoveBadAnchorObservations(const SlidingWindow& window, const LineLimits& limits,
                                LineLandmark* landmark) {
  const PluckerLine line_W = LineInWorld(*landmark, window);
  const double limit = limits.max_view_error * limits.max_view_error;
  const auto is_bad = [&](const LineLandmark::Observation& observation) {
    return MeanSquareError(line_W, observation, limits.triangulation.noise, window) > limit;
  };
  return static_cast<int>(RemoveObservationsIf(is_bad, &landmark->anchor_observations));
}

// Removes outlier observations in the host's camera except the host. Returns their number, and the
// mean square error of the remaining ones; infinite if only the host remains.
std::pair<int, double> RemoveBadObservations(const SlidingWindow& window, const LineLimits& limits,
                                             LineLandmark* landmark) {
  const PluckerLine line_W = LineInWorld(*landmark, window);
  const double limit = limits.max_view_error * limits.max_view_error;
  auto& observations = landmark->observations;
  double sum = 0;
  int removed = 0, count = 0;
  for (size_t i = 0; i < observations.size();) {
    if (observations[i].camera != landmark->host().camera) {
      ++i;
      continue;
    }
    const double error =
        MeanSquareError(line_W, observations[i], limits.triangulation.noise, window);
    if (i > 0 && error > limit) {
      observations.erase(observations.begin() + i);
      ++removed;
    } else {
      sum += error;
      ++count;
      ++i;
    }
  }
  return {removed, count > 1 ? sum / count : std::numeric_limits<double>::infinity()};
}

}  // namespace

void MoveHost(const SlidingWindow& window, size_t observation, LineLandmark* landmark) {
  const Rigid3d T_W_C = window.T_W_C(landmark->observations[observation]);
  const PluckerLine line_C = T_W_C.Inverse() * LineInWorld(*landmark, window);
  const double direction = line_C.direction.norm();
  landmark->triangulated = direction > 0 && line_C.moment.norm() > kMinDistance * direction;
  if (landmark->triangulated) landmark->coordinates = ToOrthonormal(line_C);
}

void KeepNewestFrame(const SlidingWindow& window, LineLandmark* landmark) {
  KeepNewestFrame<LineLandmark>(window, landmark);
  landmark->anchor_observations.clear();
}

std::optional<Eigen::Vector2d> DistancesOf(const LineLandmark::Observation& observation,
                                           const PluckerLine& line_W, const SlidingWindow& window) {
  const PluckerLine line_C = window.T_W_C(observation).Inverse() * line_W;
  Eigen::Vector2d distances;
  if (!EndPointDistances(observation.segment, line_C.moment, &distances, nullptr)) {
    return std::nullopt;
  }
  return distances;
}

std::vector<PosedLineObservation> PosedOfHostCamera(const LineLandmark& landmark,
                                                    const SlidingWindow& window) {
  std::vector<PosedLineObservation> posed;
  for (const auto& observation : OfHostCamera(landmark)) {
    posed.push_back(Posed(observation, window));
  }
  return posed;
}

PluckerLine LineInWorld(const LineLandmark& landmark, const SlidingWindow& window) {
  return window.T_W_C(landmark.host()) * ToPlucker(landmark.coordinates.data());
}

std::optional<MapLine> ObservedSegment(const LineLandmark& landmark, const SlidingWindow& window) {
  const PluckerLine line_W = LineInWorld(landmark, window);
  const Eigen::Vector3d foot = NearestToOrigin(line_W);
  const Eigen::Vector3d along = line_W.direction.normalized();
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const PosedLineObservation& observation : PosedOfHostCamera(landmark, window)) {
    const Rigid3d& T_W_C = observation.T_W_C;
    const LineEnds ends_C = EndsOf(T_W_C.Inverse() * line_W, observation.segment);
    if (!IsInFront(ends_C)) return std::nullopt;
    for (const Eigen::Vector3d& end_C : {ends_C.start, ends_C.end}) {
      const double place = along.dot(T_W_C * end_C - foot);
      first = std::min(first, place);
      last = std::max(last, place);
    }
  }
  return MapLine{landmark.id, foot + first * along, foot + last * along, landmark.axis};
}

void LineMap::AddFrame(const LineFrame& frame) {
  for (const LineObservation& line : frame.lines) {
    if (!((line.end - line.start).norm() > kMinSegment)) continue;
    LineLandmark& landmark = landmarks_[line.id];
    landmark.id = line.id;
    landmark.observations.push_back(
        {{frame.t_ns, line.camera}, {line.start, line.end}, line.deviation});
  }
}

LineTriangulationCounts LineMap::Triangulate(const SlidingWindow& window,
                                             const LineLimits& limits) {
  LineTriangulationCounts counts;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    LineLandmark& landmark = it->second;
    if (landmark.triangulated ||
        CountMeasurements(landmark.observations) < kMinMeasurementsToTriangulate) {
      ++it;
      continue;
    }
    LineTriangulationResult result = TriangulateLandmark(window, limits.triangulation, &landmark);
    if (landmark.triangulated && IsTooLong(landmark, window, limits.max_length)) {
      result = LineTriangulationResult::kTooLong;
    }
    Count(result, &counts);
    const bool stays = result == LineTriangulationResult::kOk ||
                       result == LineTriangulationResult::kDegenerate ||
                       StartWithoutDepth(&landmark);
    it = stays ? std::next(it) : landmarks_.erase(it);
  }
  return counts;
}

std::vector<MapLine> LineMap::Optimized(const SlidingWindow& window) const {
  std::vector<MapLine> lines;
  for (const auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    if (const auto segment = ObservedSegment(landmark, window)) lines.push_back(*segment);
  }
  return lines;
}

int LineMap::RemoveOutliers(const SlidingWindow& window, const LineLimits& limits) {
  int removed = 0;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    LineLandmark& landmark = it->second;
    if (!landmark.triangulated || !IsInSeveralFrames(landmark)) {
      ++it;
      continue;
    }
    removed += RemoveBadAnchorObservations(window, limits, &landmark);
    const auto [bad, mean_square] = RemoveBadObservations(window, limits, &landmark);
    const auto segment = ObservedSegment(landmark, window);
    const double max_mean_error = limits.triangulation.max_mean_error;
    const bool is_outlier = !segment || Length(*segment) > limits.max_length ||
                            mean_square > max_mean_error * max_mean_error;
    removed += bad + is_outlier;
    const bool stays = !is_outlier || StartWithoutDepth(&landmark);
    it = stays ? std::next(it) : landmarks_.erase(it);
  }
  return removed;
}

std::vector<LineResidual> LineMap::ResidualsIn(int camera, double noise,
                                               const SlidingWindow& window) const {
  std::vector<LineResidual> residuals;
  for (const auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const PluckerLine line_W = LineInWorld(landmark, window);
    for (const LineLandmark::Observation& observation : landmark.observations) {
      if (observation.camera != camera) continue;
      const auto distances = DistancesOf(observation, line_W, window);
      const double error = distances
                               ? distances->cwiseProduct(observation.Weights(1 / noise)).norm()
                               : std::numeric_limits<double>::infinity();
      residuals.push_back({id, observation, landmark.host().camera == camera, error});
    }
  }
  return residuals;
}

void LineMap::RemoveAnchor(int64_t t_ns) {
  for (auto& [id, landmark] : landmarks_) RemoveObservationsIn(t_ns, &landmark.anchor_observations);
}

}  // namespace plm_vins
