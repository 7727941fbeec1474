// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plm_vins {
namespace {

constexpr int kMinMeasurementsOfLine = 3;
constexpr double kMaxRightNoise = 2.0;  // largest noise of a second-camera segment, over the noise
constexpr double kMinSegment = 1e-3;    // normalized
constexpr double kMinDistance = 1e-6;   // distance of a line from its host's camera [m]

LineTriangulationResult TriangulateLandmark(const SlidingWindow& window,
                                            const LineTriangulationOptions& options,
                                            LineLandmark* landmark) {
  std::vector<PosedLineObservation> observations = ObservationsOf(landmark->views, window);
  for (const LineView& view : landmark->views) {
    if (view.right && view.right->deviation.maxCoeff() < kMaxRightNoise * options.noise) {
      observations.push_back({window.T_W_C1(view.t_ns), {view.right->start, view.right->end}});
    }
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
double MeanSquareError(const PluckerLine& line_W, const LineView& view, double noise,
                       const SlidingWindow& window) {
  const auto distances = DistancesOf(view, line_W, window);
  if (!distances) return std::numeric_limits<double>::infinity();
  return 0.5 * distances->squaredNorm() / (noise * noise);
}

// Removes outliers among the observations in anchors. Returns the number of removed observations.
int RemoveBadAnchorViews(const SlidingWindow& window, const LineLimits& limits,
                         LineLandmark* landmark) {
  const PluckerLine line_W = LineInWorld(*landmark, window);
  const double limit = limits.max_view_error * limits.max_view_error;
  std::vector<LineView>& views = landmark->anchor_views;
  const size_t before = views.size();
  views.erase(std::remove_if(views.begin(), views.end(),
                             [&](const LineView& view) {
                               return MeanSquareError(line_W, view, limits.triangulation.noise,
                                                      window) > limit;
                             }),
              views.end());
  return static_cast<int>(before - views.size());
}

// Removes outlier observations except the host's. Returns the number of removed observations, and
// the mean square error of the remaining ones.
int RemoveBadViews(const SlidingWindow& window, const LineLimits& limits, LineLandmark* landmark,
                   double* mean_square) {
  const PluckerLine line_W = LineInWorld(*landmark, window);
  const double limit = limits.max_view_error * limits.max_view_error;
  const size_t before = landmark->views.size();
  double sum = 0;
  for (size_t i = 0; i < landmark->views.size();) {
    const double error =
        MeanSquareError(line_W, landmark->views[i], limits.triangulation.noise, window);
    if (i > 0 && error > limit) {
      landmark->views.erase(landmark->views.begin() + i);
    } else {
      sum += error;
      ++i;
    }
  }
  *mean_square = sum / static_cast<double>(landmark->views.size());
  return static_cast<int>(before - landmark->views.size());
}

}  // namespace

void MoveHost(const SlidingWindow& window, size_t view, LineLandmark* landmark) {
  const Rigid3d T_W_C = window.T_W_C(landmark->views[view].t_ns);
  const PluckerLine line_C = T_W_C.Inverse() * LineInWorld(*landmark, window);
  const double direction = line_C.direction.norm();
  landmark->triangulated = direction > 0 && line_C.moment.norm() > kMinDistance * direction;
  if (landmark->triangulated) landmark->coordinates = ToOrthonormal(line_C);
}

void KeepOnlyView(const SlidingWindow& window, size_t view, LineLandmark* landmark) {
  KeepOnlyView<LineLandmark>(window, view, landmark);
  landmark->anchor_views.clear();
}

std::optional<Eigen::Vector2d> DistancesOf(const LineView& view, const PluckerLine& line_W,
                                           const SlidingWindow& window) {
  const PluckerLine line_C = window.T_W_C(view.t_ns).Inverse() * line_W;
  Eigen::Vector2d distances;
  if (!EndPointDistances(view.segment, line_C.moment, &distances, nullptr)) return std::nullopt;
  return distances;
}

PosedLineObservation ObservationOf(const LineView& view, const SlidingWindow& window) {
  return {window.T_W_C(view.t_ns), view.segment};
}

std::vector<PosedLineObservation> ObservationsOf(const std::vector<LineView>& views,
                                                 const SlidingWindow& window) {
  std::vector<PosedLineObservation> observations;
  observations.reserve(views.size());
  for (const LineView& view : views) observations.push_back(ObservationOf(view, window));
  return observations;
}

PluckerLine LineInWorld(const LineLandmark& landmark, const SlidingWindow& window) {
  const Rigid3d T_W_Ch = window.T_W_C(landmark.host().t_ns);
  return T_W_Ch * ToPlucker(landmark.coordinates.data());
}

std::optional<MapLine> ObservedSegment(const LineLandmark& landmark, const SlidingWindow& window) {
  const PluckerLine line_W = LineInWorld(landmark, window);
  const Eigen::Vector3d foot = NearestToOrigin(line_W);
  const Eigen::Vector3d along = line_W.direction.normalized();
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const LineView& view : landmark.views) {
    const Rigid3d T_W_C = window.T_W_C(view.t_ns);
    const LineEnds ends_C = EndsOf(T_W_C.Inverse() * line_W, view.segment);
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
    landmark.views.push_back({frame.t_ns, {line.start, line.end}, line.right});
  }
}

LineTriangulationCounts LineMap::Triangulate(const SlidingWindow& window,
                                             const LineLimits& limits) {
  LineTriangulationCounts counts;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    LineLandmark& landmark = it->second;
    if (landmark.triangulated || CountMeasurements(landmark.views) < kMinMeasurementsOfLine) {
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
    if (!landmark.triangulated || landmark.views.size() < 2) {
      ++it;
      continue;
    }
    double mean_square = 0;
    removed += RemoveBadAnchorViews(window, limits, &landmark);
    removed += RemoveBadViews(window, limits, &landmark, &mean_square);
    const auto segment = ObservedSegment(landmark, window);
    const double max_mean_error = limits.triangulation.max_mean_error;
    const bool bad = !segment || Length(*segment) > limits.max_length ||
                     landmark.views.size() < 2 || mean_square > max_mean_error * max_mean_error;
    removed += bad;
    const bool stays = !bad || StartWithoutDepth(&landmark);
    it = stays ? std::next(it) : landmarks_.erase(it);
  }
  return removed;
}

std::vector<RightLineResidual> LineMap::RightResiduals(const SlidingWindow& window) {
  std::vector<RightLineResidual> residuals;
  for (auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const PluckerLine line_W = LineInWorld(landmark, window);
    for (LineView& view : landmark.views) {
      if (!view.right) continue;
      const PluckerLine line_C1 = window.T_W_C1(view.t_ns).Inverse() * line_W;
      Eigen::Vector2d distances;
      if (EndPointDistances({view.right->start, view.right->end}, line_C1.moment, &distances,
                            nullptr)) {
        residuals.push_back({&view, distances.cwiseQuotient(view.right->deviation).norm()});
      } else {
        view.right.reset();
      }
    }
  }
  return residuals;
}

void LineMap::RemoveAnchor(int64_t t_ns) {
  for (auto& [id, landmark] : landmarks_) RemoveViewsOf(t_ns, &landmark.anchor_views);
}

}  // namespace plm_vins
