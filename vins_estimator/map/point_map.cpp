// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/point_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/median.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kMinMeasurementsOfPoint = 2;
constexpr size_t kMinPoints = 10;  // fewer do not represent the scene

PosedPointObservation ObservationOf(const PointView& view, const SlidingWindow& window) {
  return {window.T_W_C(view.t_ns), window.AtState(view.bearing)};
}

// Returns the observation by the second camera, which must exist.
PosedPointObservation RightObservationOf(const PointView& view, const SlidingWindow& window) {
  return {window.T_W_C1(view.t_ns), window.AtState(view.RightBearing())};
}

// Sets the coordinates of a landmark in the camera of one of its observations; marks it as not
// triangulated if it is behind that camera.
void SetPosition(const Eigen::Vector3d& p_W, const SlidingWindow& window, const PointView& view,
                 PointLandmark* landmark) {
  const Rigid3d T_W_C = window.T_W_C(view.t_ns);
  const Eigen::Vector3d p_C = T_W_C.Inverse() * p_W;
  landmark->triangulated = p_C.z() > kMinLandmarkDepth;
  if (landmark->triangulated) {
    landmark->coordinates = {p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1.0 / p_C.z()};
  }
}

// Returns the position at the first measured depth; nullopt without one.
std::optional<Eigen::Vector3d> AtMeasuredDepth(const PointLandmark& landmark,
                                               const SlidingWindow& window) {
  for (const PointView& view : landmark.views) {
    if (!view.depth || *view.depth < kMinTriangulatedDepth) continue;
    const PosedPointObservation observation = ObservationOf(view, window);
    return observation.T_W_C * (*view.depth * observation.xy.homogeneous());
  }
  return std::nullopt;
}

std::vector<PosedPointObservation> WithRightObservations(
    std::vector<PosedPointObservation> observations, const PointLandmark& landmark,
    const SlidingWindow& window) {
  for (const PointView& view : landmark.views) {
    if (view.right) observations.push_back(RightObservationOf(view, window));
  }
  return observations;
}

void TriangulateLandmark(const SlidingWindow& window, double min_angle, PointLandmark* landmark) {
  std::vector<PosedPointObservation> observations;
  observations.reserve(landmark->views.size());
  for (const PointView& view : landmark->views) observations.push_back(ObservationOf(view, window));
  const std::vector<PosedPointObservation> all =
      WithRightObservations(observations, *landmark, window);
  auto p_W = TriangulatePoint(all, min_angle);
  if (!p_W && all.size() > observations.size()) p_W = TriangulatePoint(observations, min_angle);
  if (!p_W) p_W = AtMeasuredDepth(*landmark, window);
  if (p_W) SetPosition(*p_W, window, landmark->host(), landmark);
}

double TimeSeen(const PointLandmark& landmark) {
  return ToSeconds(landmark.views.back().t_ns - landmark.views.front().t_ns);
}

// Returns the common motion [rad/s] of the points in the newest image that are not triangulated:
// the median from the first observation of each, without the rotation of the window. Zero for few.
double CommonMotion(const PointMap::Landmarks& landmarks, const SlidingWindow& window) {
  std::vector<double> right, down;
  for (const auto& [id, landmark] : landmarks) {
    if (landmark.triangulated || landmark.views.size() < 2) continue;
    if (landmark.views.back().t_ns != window.newest().state.t_ns) continue;
    const PosedPointObservation host = ObservationOf(landmark.host(), window);
    const PosedPointObservation newest = ObservationOf(landmark.views.back(), window);
    const Eigen::Vector3d ray =
        newest.T_W_C.rotation.inverse() * (host.T_W_C.rotation * host.xy.homogeneous());
    const Eigen::Vector2d rate = (newest.xy - ray.hnormalized()) / TimeSeen(landmark);
    right.push_back(rate.x());
    down.push_back(rate.y());
  }
  if (right.size() < kMinPoints) return 0;
  return std::hypot(Median(std::move(right)), Median(std::move(down)));
}

// Returns whether a landmark is in front of the camera in all frames with a mean reprojection error
// of at most `max_error`. Returns true without observations in a second camera or measured depths.
bool Fits(const Eigen::Vector3d& p_W, const PointLandmark& landmark, double max_error,
          const SlidingWindow& window) {
  const size_t count = landmark.views.size();
  if (CountMeasurements(landmark.views) == static_cast<int>(count)) return true;
  double sum = 0;
  for (const PointView& view : landmark.views) {
    const auto error = ReprojectionError(p_W, view, window);
    if (!error) return false;
    sum += *error;
  }
  return sum <= max_error * static_cast<double>(count);
}

// Returns whether the depth of a landmark contradicts the depth measured in an observation.
bool ContradictsDepth(const Eigen::Vector3d& p_W, const PointView& view, double max_error,
                      const SlidingWindow& window) {
  const double z = (window.T_W_C(view.t_ns).Inverse() * p_W).z();
  const TimedDepth measured = window.DepthIn(view.t_ns, *view.depth);
  const double expected = measured.Expected(1 / z, window.depth_stream.data());
  return !(std::abs(expected - 1 / measured.depth) <= max_error);
}

}  // namespace

void MoveHost(const SlidingWindow& window, size_t view, PointLandmark* landmark) {
  SetPosition(PositionInWorld(*landmark, window), window, landmark->views[view], landmark);
}

Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window) {
  const Rigid3d T_W_Ch = window.T_W_C(landmark.host().t_ns);
  return T_W_Ch * PointInHost(landmark.coordinates.data());
}

std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W, const PointView& view,
                                        const SlidingWindow& window) {
  const PosedPointObservation observation = ObservationOf(view, window);
  const Eigen::Vector3d p_C = observation.T_W_C.Inverse() * p_W;
  if (p_C.z() < kMinLandmarkDepth) return std::nullopt;
  return (p_C.hnormalized() - observation.xy).norm();
}

void PointMap::AddFrame(const PointFrame& frame, double cut_time_offset) {
  for (const PointObservation& point : frame.points) {
    PointLandmark& landmark = landmarks_[point.id];
    landmark.id = point.id;
    landmark.views.push_back(
        {frame.t_ns, {point.xy, point.velocity, cut_time_offset}, point.right, point.depth});
  }
}

void PointMap::Triangulate(const SlidingWindow& window, double min_angle,
                           double unnoticed_turn_rate) {
  const bool depth_is_unknown = window.HasStationary() && !MedianDepthInNewest(window);
  const double turn_rate =
      depth_is_unknown ? std::min(CommonMotion(landmarks_, window), unnoticed_turn_rate) : 0;
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.triangulated || CountMeasurements(landmark.views) < kMinMeasurementsOfPoint) {
      continue;
    }
    TriangulateLandmark(window, min_angle + turn_rate * TimeSeen(landmark), &landmark);
  }
}

std::vector<MapPoint> PointMap::Optimized(const SlidingWindow& window) const {
  std::vector<MapPoint> points;
  for (const auto& [id, landmark] : landmarks_) {
    if (IsOptimized(landmark)) points.push_back({id, PositionInWorld(landmark, window)});
  }
  return points;
}

PointMap::Fit PointMap::FitOfNewest(const SlidingWindow& window, int64_t keyframe_ns,
                                    double max_error) const {
  Fit fit;
  for (const auto& [id, landmark] : landmarks_) {
    if (!IsOptimizedInNewest(landmark, window) || !WasOptimizedAt(keyframe_ns, landmark)) continue;
    const PointView& newest = landmark.views.back();
    const auto error = ReprojectionError(PositionInWorld(landmark, window), newest, window);
    ++fit.seen;
    fit.contradicted += !error || *error > max_error ? 1 : 0;
  }
  return fit;
}

std::optional<double> PointMap::MedianDepthInNewest(const SlidingWindow& window) const {
  std::vector<double> depths;
  for (const auto& [id, landmark] : landmarks_) {
    if (IsOptimizedInNewest(landmark, window)) depths.push_back(1 / landmark.coordinates[2]);
  }
  if (depths.size() < kMinPoints) return std::nullopt;
  return Median(std::move(depths));
}

int PointMap::RemoveOutliers(const SlidingWindow& window, double max_error) {
  int removed = 0;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    PointLandmark& landmark = it->second;
    if (!landmark.triangulated || landmark.views.size() < 2) {
      ++it;
      continue;
    }
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    if (!Fits(p_W, landmark, max_error, window) && StartWithoutDepth(&landmark)) {
      ++removed;
      ++it;
      continue;
    }
    const double inverse_depth = landmark.coordinates[2];
    bool bad = inverse_depth <= 0 || inverse_depth > 1.0 / kMinLandmarkDepth;
    double sum = 0;
    for (size_t i = 1; i < landmark.views.size() && !bad;) {
      const auto error = ReprojectionError(p_W, landmark.views[i], window);
      bad = !error;
      if (error && *error > 2 * max_error) {
        landmark.views.erase(landmark.views.begin() + i);
        ++removed;
        continue;
      }
      sum += error.value_or(0);
      ++i;
    }
    const size_t count = landmark.views.size() - 1;
    bad = bad || count == 0 || sum / count > max_error;
    removed += bad;
    it = bad ? landmarks_.erase(it) : std::next(it);
  }
  return removed;
}

std::vector<RightResidual> PointMap::RightResiduals(const SlidingWindow& window) {
  std::vector<RightResidual> residuals;
  for (auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    for (PointView& view : landmark.views) {
      if (!view.right) continue;
      const PosedPointObservation observation = RightObservationOf(view, window);
      const Eigen::Vector3d p_C1 = observation.T_W_C.Inverse() * p_W;
      if (p_C1.z() < kMinLandmarkDepth) {
        view.right.reset();
      } else {
        residuals.push_back({&view, p_C1.hnormalized() - observation.xy});
      }
    }
  }
  return residuals;
}

DepthCounts PointMap::RemoveDepthOutliers(const SlidingWindow& window, double max_error) {
  DepthCounts counts;
  for (auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    for (PointView& view : landmark.views) {
      if (!view.depth) continue;
      const bool wrong = ContradictsDepth(p_W, view, max_error, window);
      if (wrong) view.depth.reset();
      ++(wrong ? counts.rejected : counts.used);
    }
  }
  return counts;
}

}  // namespace plm_vins
