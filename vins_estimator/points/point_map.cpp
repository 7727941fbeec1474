// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/points/point_map.h"

#include <algorithm>

#include "vins_estimator/points/point_triangulation.h"

namespace plm_vins {
namespace {

constexpr double kMinDepth = 0.05;  // [m]
constexpr size_t kMinViewsToTriangulate = 2;

PointSighting SightingOf(const PointView& view, const SlidingWindow& window) {
  return {window.T_W_C(*window.Find(view.t_ns)), view.bearing.At(window.td)};
}

void TriangulateLandmark(const SlidingWindow& window, double min_angle, PointLandmark* landmark) {
  std::vector<PointSighting> sightings;
  sightings.reserve(landmark->views.size());
  for (const PointView& view : landmark->views) sightings.push_back(SightingOf(view, window));
  const auto p_W = TriangulatePoint(sightings, min_angle);
  if (p_W) SetPosition(*p_W, window, landmark);
}

// Takes out the view in a frame; where it is the host, the depth moves on to the next view.
void RemoveView(const SlidingWindow& window, size_t index, PointLandmark* landmark) {
  if (index == 0 && landmark->triangulated && landmark->views.size() > 1) {
    const Eigen::Vector3d p_W = PositionInWorld(*landmark, window);
    landmark->views.erase(landmark->views.begin());
    SetPosition(p_W, window, landmark);
  } else {
    landmark->views.erase(landmark->views.begin() + index);
  }
}

}  // namespace

void SetPosition(const Eigen::Vector3d& p_W, const SlidingWindow& window, PointLandmark* landmark) {
  const Rigid3d T_W_Ch = window.T_W_C(*window.Find(landmark->host().t_ns));
  const Eigen::Vector3d p_C = T_W_Ch.Inverse() * p_W;
  landmark->triangulated = p_C.z() > kMinDepth;
  if (landmark->triangulated) {
    landmark->coordinates = {p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1.0 / p_C.z()};
  }
}

Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window) {
  const Rigid3d T_W_Ch = window.T_W_C(*window.Find(landmark.host().t_ns));
  return T_W_Ch * PointInHost(landmark.coordinates.data());
}

std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W, const PointView& view,
                                        const SlidingWindow& window) {
  const PointSighting sighting = SightingOf(view, window);
  const Eigen::Vector3d p_C = sighting.T_W_C.Inverse() * p_W;
  if (p_C.z() < kMinDepth) return std::nullopt;
  return (p_C.hnormalized() - sighting.xy).norm();
}

void PointMap::AddFrame(const PointFrame& frame, double cut_time_offset) {
  for (const PointObservation& point : frame.points) {
    PointLandmark& landmark = landmarks_[point.id];
    landmark.id = point.id;
    landmark.views.push_back({frame.t_ns, {point.xy, point.velocity, cut_time_offset}});
  }
}

void PointMap::RemoveFrame(const SlidingWindow& window, int64_t t_ns) {
  for (auto& [id, landmark] : landmarks_) {
    const auto view = std::find_if(landmark.views.begin(), landmark.views.end(),
                                   [t_ns](const PointView& v) { return v.t_ns == t_ns; });
    if (view == landmark.views.end()) continue;
    RemoveView(window, view - landmark.views.begin(), &landmark);
  }
  RemoveIf([](const PointLandmark& landmark) { return landmark.views.empty(); });
}

std::vector<MapPoint> PointMap::StartAnew(const SlidingWindow& window, int64_t host_ns) {
  const int64_t newest_ns = window.newest().state.t_ns;
  std::vector<MapPoint> removed;
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    PointLandmark& landmark = it->second;
    if (landmark.host().t_ns != host_ns || !landmark.triangulated || landmark.views.size() < 2) {
      ++it;
      continue;
    }
    const Eigen::Vector3d p_W = PositionInWorld(landmark, window);
    if (landmark.views.back().t_ns == newest_ns) {
      landmark.views.erase(landmark.views.begin(), landmark.views.end() - 1);
      SetPosition(p_W, window, &landmark);
      ++it;
    } else {
      removed.push_back({landmark.id, p_W});
      it = landmarks_.erase(it);
    }
  }
  return removed;
}

void PointMap::Triangulate(const SlidingWindow& window, double min_angle) {
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.triangulated || landmark.views.size() < kMinViewsToTriangulate) continue;
    TriangulateLandmark(window, min_angle, &landmark);
  }
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
    const double inverse_depth = landmark.coordinates[2];
    bool bad = inverse_depth <= 0 || inverse_depth > 1.0 / kMinDepth;
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

void PointMap::RemoveIf(const std::function<bool(const PointLandmark&)>& condition) {
  for (auto it = landmarks_.begin(); it != landmarks_.end();) {
    it = condition(it->second) ? landmarks_.erase(it) : std::next(it);
  }
}

}  // namespace plm_vins
