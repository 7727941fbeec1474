// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "common/camera/camera_model.h"
#include "common/measurements.h"
#include "vins_estimator/map/local_map.h"

namespace plm_vins {

// Moves rays from one calibration of the camera to another: to where that sees the same pixels.
class Recalibration {
 public:
  Recalibration(const CameraParameters& from, const CameraParameters& to)
      : from_(CameraModel::Create(from)), to_(CameraModel::Create(to)) {}

  // How far it moves rays at most: of a grid over the image, normalised.
  double LargestMove() const;

  // A ray (x, y, 1) by its normalised image point. One that either calibration does not see, at the
  // rim of what a distortion can describe, stays where it is.
  void Move(Eigen::Vector2d* xy) const;

  // The same, with its velocity in the image.
  void Move(Eigen::Vector2d* xy, Eigen::Vector2d* velocity) const;

  // All rays of an image, and of a map.
  void Move(FrameMeasurement* measurement) const;
  void Move(LocalMap* map) const;

 private:
  void Move(LineView* view) const;

  std::shared_ptr<const CameraModel> from_, to_;
};

// Brings all rays of a map to the intrinsics of its window, once one of them is wrong by
// `max_error` (normalised). `camera`: as configured.
void FollowIntrinsics(const CameraParameters& camera, double max_error, LocalMap* map);

}  // namespace plm_vins
