// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/measurements.h"
#include "vins_estimator/map/landmark_map.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/state/estimate_counts.h"
#include "vins_estimator/state/map_elements.h"

namespace plm_vins {

// Residual of an observation after optimization.
struct PointResidual {
  int64_t id;  // of the landmark
  ImageKey image;
  bool is_in_host_camera;
  Eigen::Vector2d error;  // projection minus observation, normalized; infinite behind the camera
  Eigen::Vector2d flow;   // velocity in the image [1/s]
};

// All corner tracks with observations in the window. Every observation belongs to a frame of it.
class PointMap : public LandmarkMap<PointLandmark> {
 public:
  // Adds one image's corners as observations.
  void AddFrame(const PointFrame& frame, double cut_time_offset);

  // Triangulates the points with enough observations whose rays differ by at least `min_angle`
  // [rad]. After a standstill, while no depth is known, the rays must also differ by more than the
  // common motion of the points, because it may be a rotation that the bias of the gyro hides; up
  // to `unnoticed_turn_rate` [rad/s].
  void Triangulate(const SlidingWindow& window, double min_angle, double unnoticed_turn_rate = 0);

  // Returns the optimized points in the world.
  std::vector<MapPoint> Optimized(const SlidingWindow& window) const;

  // Counts the landmarks that were optimized at a keyframe and are observed in the newest image,
  // and those of them whose reprojection error there exceeds `max_error`.
  struct Fit {
    int seen = 0, contradicted = 0;
  };
  Fit FitOfNewest(const SlidingWindow& window, int64_t keyframe_ns, double max_error) const;

  // Returns the median depth of the optimized points in the newest image [m]; nullopt for few
  // points.
  std::optional<double> MedianDepthInNewest(const SlidingWindow& window) const;

  // Judges landmarks by their observations in the host's camera. Removes those that are behind it
  // or have a mean reprojection error above `max_error`, and single observations with more than
  // twice that (normalized). Returns the number of removed landmarks and observations.
  int RemoveOutliers(const SlidingWindow& window, double max_error);

  // Returns the residuals of the optimized points in the images of a camera.
  std::vector<PointResidual> ResidualsIn(int camera, const SlidingWindow& window) const;

  // Drops measured depths whose inverse [1/m] is off by more than `max_error`. The points stay.
  DepthCounts RemoveDepthOutliers(const SlidingWindow& window, double max_error);
};

// Transforms a landmark's coordinates to the camera of another observation; marks it as not
// triangulated if it is behind that camera.
void MoveHost(const SlidingWindow& window, size_t observation, PointLandmark* landmark);

// Returns a measured depth with what its stream's calibration changes.
TimedDepth MeasuredDepth(const PointLandmark::Observation& observation,
                         const SlidingWindow& window);

// Returns the position of a triangulated landmark in the world.
Eigen::Vector3d PositionInWorld(const PointLandmark& landmark, const SlidingWindow& window);

// Returns the reprojection error of a landmark in one of its observations, normalized; nullopt if
// it is behind that camera.
std::optional<double> ReprojectionError(const Eigen::Vector3d& p_W,
                                        const PointLandmark::Observation& observation,
                                        const SlidingWindow& window);

}  // namespace plm_vins
