// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "common/camera/camera_model.h"
#include "common/config/sensor_config.h"
#include "common/measurements.h"
#include "vins_estimator/map/local_map.h"

namespace plm_vins {

// Transforms rays from one camera calibration to another, such that they project to the same
// pixels.
class Recalibration {
 public:
  Recalibration(const CameraParameters& from, const CameraParameters& to)
      : from_(CameraModel::Create(from)), to_(CameraModel::Create(to)) {}

  // Returns the greatest shift of a ray over a grid in the image, normalized.
  double LargestMove() const;

  // Transforms a ray (x, y, 1), given by its normalized image point. Rays outside the range of
  // either calibration, at the rim of the distortion model, are not changed.
  void Move(Eigen::Vector2d* xy) const;

  // Transforms a ray together with its velocity in the image.
  void Move(Eigen::Vector2d* xy, Eigen::Vector2d* velocity) const;

  // Transforms all rays of a camera in a measurement or a map.
  void Move(int camera, FrameMeasurement* measurement) const;
  void Move(int camera, LocalMap* map) const;

 private:
  std::shared_ptr<const CameraModel> from_, to_;
};

// Recomputes all rays of a map with the current intrinsics of its window, camera by camera, once
// these shift a ray by `max_error` (normalized). `sensor` has the configured cameras.
void FollowIntrinsics(const SensorConfig& sensor, double max_error, LocalMap* map);

}  // namespace plm_vins
