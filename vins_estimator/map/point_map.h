// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// All corner tracks with views in the window. Every view belongs to a frame of the window.
class PointMap : public LandmarkMap<PointLandmark> {
 public:
  // Adds one image's corners as views.
  void AddFrame(const PointFrame& frame, const ImageTiming& timing);

  // Triangulates what can be; `min_angle` [rad] is the least angle between rays.
  void Triangulate(const SlidingWindow& window, double min_angle);

  // Those that are optimised, in the world.
  std::vector<MapPoint> Optimized(const SlidingWindow& window) const;

  // How many of the landmarks that were optimised at a keyframe the newest image shows, and how
  // many of them further than `max_error` from where they should be.
  struct Fit {
    int seen = 0, contradicted = 0;
  };
  Fit FitOfNewest(const SlidingWindow& window, int64_t keyframe_ns, double max_error) const;

  // Of the optimised points that the newest image shows [m]; nothing where those are few.
  std::optional<double> MedianDepthInNewest(const SlidingWindow& window) const;

  // Removes landmarks behind a camera or with a mean reprojection error above `max_error`, and
  // single views above twice that (normalised image units). Returns how many landmarks and views
  // were removed.
  int RemoveOutliers(const SlidingWindow& window, double max_error);
};

// Expresses a landmark's coordinates in the camera of another of its views; not triangulated where
// it is not in front of that.
void MoveHost(const SlidingWindow& window, size_t view, PointLandmark* landmark);

// Position of a triangulated landmark in the world.
Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window);

// Reprojection error of a triangulated landmark in one of its views, in normalised image units.
// Nothing where it is behind that camera.
std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W, const PointView& view,
                                        const SlidingWindow& window);

}  // namespace plm_vins
