// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/points/point_landmark.h"
#include "vins_estimator/window/sliding_window.h"

namespace plm_vins {

// A landmark's place in the world, for output.
struct MapPoint {
  int64_t id = -1;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  // [m]
};

// All corner tracks with views in the window. Every view belongs to a frame of the window.
class PointMap {
 public:
  // Ordered by id, so that every sum over landmarks is the same in every run.
  using Landmarks = std::map<int64_t, PointLandmark>;

  // Adds one image's corners as views. `cut_time_offset`: see TimedBearing.
  void AddFrame(const PointFrame& frame, double cut_time_offset);

  // Removes all views in a frame, and landmarks without views. A host's depth moves to the next
  // view.
  void RemoveFrame(const SlidingWindow& window, int64_t t_ns);

  // For the landmarks hosted by a frame, whose views have gone into the prior and must not count
  // again: those still seen keep only their newest view, as host of a fresh start at the same
  // place; the others are removed. Returns the positions of the latter.
  std::vector<MapPoint> StartAnew(const SlidingWindow& window, int64_t host_ns);

  // Triangulates what can be; `min_angle` [rad] is the least angle between rays.
  void Triangulate(const SlidingWindow& window, double min_angle);

  // Removes landmarks behind a camera or with a mean reprojection error above `max_error`, and
  // single views above twice that (normalised image units). Returns how many landmarks and views
  // went.
  int RemoveOutliers(const SlidingWindow& window, double max_error);

  // Removes the landmarks that `condition` selects.
  void RemoveIf(const std::function<bool(const PointLandmark&)>& condition);

  void Clear() { landmarks_.clear(); }

  Landmarks& landmarks() { return landmarks_; }
  const Landmarks& landmarks() const { return landmarks_; }

 private:
  Landmarks landmarks_;
};

// Expresses a point in the landmark's host; not triangulated where it is not in front of it.
void SetPosition(const Eigen::Vector3d& p_W, const SlidingWindow& window, PointLandmark* landmark);

// Position of a triangulated landmark in the world.
Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window);

// Reprojection error of a triangulated landmark in one of its views, in normalised image units.
// Nothing where it is behind that camera.
std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W, const PointView& view,
                                        const SlidingWindow& window);

}  // namespace plm_vins
