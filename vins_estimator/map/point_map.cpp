// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/point_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/statistics.h"
#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/geometry/depth_slopes.h"
#include "vins_estimator/geometry/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr int kMinMeasurementsOfPoint = 2;
constexpr size_t kMinPoints = 10;  // fewer do not represent the scene

PosedPointObservation Posed(const PointLandmark::Observation& observation,
                            const SlidingWindow& window) {
  return {window.T_W_C(observation), window.AtState(observation.bearing)};
}

std::vector<PosedPointObservation> Posed(
    const std::vector<PointLandmark::Observation>& observations, const SlidingWindow& window) {
  std::vector<PosedPointObservation> posed;
  posed.reserve(observations.size());
  for (const auto& observation : observations) posed.push_back(Posed(observation, window));
  return posed;
}

// Sets the coordinates of a landmark in the camera of an image; marks it as not triangulated if it
// is behind that camera.
void SetPosition(const Eigen::Vector3d& p_W, const SlidingWindow& window, const ImageKey& image,
                 PointLandmark* landmark) {
  const Eigen::Vector3d p_C = window.T_W_C(image).Inverse() * p_W;
  landmark->triangulated = p_C.z() > kMinLandmarkDepth;
  if (landmark->triangulated) {
    landmark->coordinates = {p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1.0 / p_C.z()};
  }
}

// Returns the position at the first measured depth; nullopt without one.
std::optional<Eigen::Vector3d> AtMeasuredDepth(const PointLandmark& landmark,
                                               const SlidingWindow& window) {
  for (const PointLandmark::Observation& observation : landmark.observations) {
    if (!observation.depth || *observation.depth < kMinTriangulatedDepth) continue;
    const PosedPointObservation posed = Posed(observation, window);
    return posed.T_W_C * (*observation.depth * posed.xy.homogeneous());
  }
  return std::nullopt;
}

// Observations by other cameras than the host's may be wrong matches: tries without them as well.
void TriangulateLandmark(const SlidingWindow& window, double min_angle, PointLandmark* landmark) {
  auto p_W = TriangulatePoint(Posed(landmark->observations, window), min_angle);
  if (!p_W) {
    const auto own = OfHostCamera(*landmark);
    if (own.size() < landmark->observations.size()) {
      p_W = TriangulatePoint(Posed(own, window), min_angle);
    }
  }
  if (!p_W) p_W = AtMeasuredDepth(*landmark, window);
  if (p_W) SetPosition(*p_W, window, landmark->host(), landmark);
}

double TimeSeen(const PointLandmark& landmark) {
  return ToSeconds(landmark.observations.back().t_ns - landmark.host().t_ns);
}

// Returns the common motion [rad/s] of the points in the newest image of the first camera that are
// not triangulated: the median from the first observation of each, without the rotation of the
// window. Zero for few.
double CommonMotion(const PointMap::Landmarks& landmarks, const SlidingWindow& window) {
  std::vector<double> x_rates, y_rates;
  for (const auto& [id, landmark] : landmarks) {
    if (landmark.triangulated || !IsInSeveralFrames(landmark)) continue;
    const PointLandmark::Observation& last = landmark.observations[FirstInNewest(landmark)];
    if (last.t_ns != window.newest().state.t_ns) continue;
    if (landmark.host().camera != 0 || last.camera != 0) continue;
    const PosedPointObservation host = Posed(landmark.host(), window);
    const PosedPointObservation newest = Posed(last, window);
    const Eigen::Vector3d ray =
        newest.T_W_C.rotation.inverse() * (host.T_W_C.rotation * host.xy.homogeneous());
    const Eigen::Vector2d rate = (newest.xy - ray.hnormalized()) / TimeSeen(landmark);
    x_rates.push_back(rate.x());
    y_rates.push_back(rate.y());
  }
  if (x_rates.size() < kMinPoints) return 0;
  return std::hypot(Median(std::move(x_rates)), Median(std::move(y_rates)));
}

// Returns whether a landmark is in front of the host's camera in all its images with a mean
// reprojection error of at most `max_error`.
bool FitsHostCamera(const Eigen::Vector3d& p_W, const PointLandmark& landmark, double max_error,
                    const SlidingWindow& window) {
  double sum = 0, count = 0;
  for (const PointLandmark::Observation& observation : landmark.observations) {
    if (observation.camera != landmark.host().camera) continue;
    const auto error = ReprojectionError(p_W, observation, window);
    if (!error) return false;
    sum += *error;
    ++count;
  }
  return sum <= max_error * count;
}

// Removes outliers among the observations in the host's camera. Returns their number, and whether
// the landmark is an outlier itself.
std::pair<int, bool> RemoveBadObservations(const Eigen::Vector3d& p_W, double max_error,
                                           const SlidingWindow& window, PointLandmark* landmark) {
  const double inverse_depth = landmark->coordinates[2];
  if (inverse_depth <= 0 || inverse_depth > 1.0 / kMinLandmarkDepth) return {0, true};
  auto& observations = landmark->observations;
  int removed = 0, count = 0;
  double sum = 0;
  for (size_t i = 1; i < observations.size();) {
    const bool is_own = observations[i].camera == landmark->host().camera;
    const std::optional<double> error =
        is_own ? ReprojectionError(p_W, observations[i], window) : 0;
    if (!error) return {removed, true};
    if (*error > 2 * max_error) {
      observations.erase(observations.begin() + i);
      ++removed;
      continue;
    }
    sum += *error;
    count += is_own;
    ++i;
  }
  return {removed, count == 0 || sum / count > max_error};
}

// Returns whether the depth of a landmark contradicts the depth measured in an observation.
bool ContradictsDepth(const Eigen::Vector3d& p_W, const PointLandmark::Observation& observation,
                      double max_error, const SlidingWindow& window) {
  const double z = (window.T_W_C(observation).Inverse() * p_W).z();
  const TimedDepth measured = MeasuredDepth(observation, window);
  const double expected = measured.Expected(1 / z, window.depth_stream.data());
  return !(std::abs(expected - 1 / measured.depth) <= max_error);
}

}  // namespace

TimedDepth MeasuredDepth(const PointLandmark::Observation& observation,
                         const SlidingWindow& window) {
  const FrameState& state = window.StateAt(observation.t_ns);
  const Eigen::Vector3d v_C = window.T_W_C(observation).rotation.conjugate() * state.velocity();
  return {*observation.depth, v_C.z(), observation.depth_slope, observation.bearing.xy,
          observation.bearing.velocity};
}

void MoveHost(const SlidingWindow& window, size_t observation, PointLandmark* landmark) {
  SetPosition(PositionInWorld(*landmark, window), window, landmark->observations[observation],
              landmark);
}

Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window) {
  return window.T_W_C(landmark.host()) * PointInHost(landmark.coordinates.data());
}

std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W,
                                        const PointLandmark::Observation& observation,
                                        const SlidingWindow& window) {
  const PosedPointObservation posed = Posed(observation, window);
  const Eigen::Vector3d p_C = posed.T_W_C.Inverse() * p_W;
  if (p_C.z() < kMinLandmarkDepth) return std::nullopt;
  return (p_C.hnormalized() - posed.xy).norm();
}

void PointMap::AddFrame(const PointFrame& frame, double cut_time_offset) {
  const std::vector<Eigen::Vector2d> slopes = DepthSlopes(frame);
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const PointObservation& point = frame.points[i];
    PointLandmark& landmark = landmarks_[point.id];
    landmark.id = point.id;
    landmark.observations.push_back({{frame.t_ns, point.camera},
                                     {point.xy, point.velocity, cut_time_offset},
                                     point.depth,
                                     slopes[i]});
  }
}

void PointMap::Triangulate(const SlidingWindow& window, double min_angle,
                           double unnoticed_turn_rate) {
  const bool depth_is_unknown = window.HasStationary() && !MedianDepthInNewest(window);
  const double turn_rate =
      depth_is_unknown ? std::min(CommonMotion(landmarks_, window), unnoticed_turn_rate) : 0;
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.triangulated ||
        CountMeasurements(landmark.observations) < kMinMeasurementsOfPoint) {
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
    const PointLandmark::Observation& newest = landmark.observations[FirstInNewest(landmark)];
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
    bool is_bad = false;
    if (landmark.triangulated && IsInSeveralFrames(landmark)) {
      const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
      if (MeasuresDepth(landmark) && !FitsHostCamera(p_W, landmark, max_error, window)) {
        removed += StartWithoutDepth(&landmark);
      } else {
        const auto [bad, is_outlier] = RemoveBadObservations(p_W, max_error, window, &landmark);
        is_bad = is_outlier;
        removed += bad + is_bad;
      }
    }
    it = is_bad ? landmarks_.erase(it) : std::next(it);
  }
  return removed;
}

std::vector<PointResidual> PointMap::ResidualsIn(int camera, const SlidingWindow& window) const {
  std::vector<PointResidual> residuals;
  for (const auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    for (const PointLandmark::Observation& observation : landmark.observations) {
      if (observation.camera != camera) continue;
      const PosedPointObservation posed = Posed(observation, window);
      const Eigen::Vector3d p_C = posed.T_W_C.Inverse() * p_W;
      Eigen::Vector2d error = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
      if (p_C.z() >= kMinLandmarkDepth) error = p_C.hnormalized() - posed.xy;
      residuals.push_back(
          {id, observation, landmark.host().camera == camera, error, observation.bearing.velocity});
    }
  }
  return residuals;
}

DepthCounts PointMap::RemoveDepthOutliers(const SlidingWindow& window, double max_error) {
  DepthCounts counts;
  for (auto& [id, landmark] : landmarks_) {
    if (!IsOptimized(landmark)) continue;
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    for (PointLandmark::Observation& observation : landmark.observations) {
      if (!observation.depth) continue;
      const bool wrong = ContradictsDepth(p_W, observation, max_error, window);
      if (wrong) observation.depth.reset();
      ++(wrong ? counts.rejected : counts.used);
    }
  }
  return counts;
}

}  // namespace plm_vins
