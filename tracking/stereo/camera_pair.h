// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/stereo_pairs.h"
#include "common/geometry/rigid3.h"

namespace plm_vins {

// A point on an epipolar curve.
struct CurvePoint {
  double inverse_depth = 0;  // along the optical axis of the first camera [1/m]
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // in the second camera
};

// Two rigidly mounted cameras that expose at the same time. A ray (x, y, 1) of the first camera C
// projects to an epipolar curve in the raw image of the second camera S, bent by distortion.
class CameraPair {
 public:
  CameraPair(std::shared_ptr<const CameraModel> first, std::shared_ptr<const CameraModel> second,
             const Rigid3d& T_S_C, const StereoPair& numbers = {});

  // Returns the pixel in the second camera of the point at this inverse depth [1/m] on the ray of
  // `xy`. Negative inverse depths continue the curve beyond infinity. Returns nullopt if the second
  // camera does not observe the point.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector2d& xy, double inverse_depth) const;

  // Returns the point of Project() in normalized, undistorted coordinates of S; nullopt if it is
  // not in front of S.
  std::optional<Eigen::Vector2d> Transfer(const Eigen::Vector2d& xy, double inverse_depth) const;

  // Returns the inverse depth [1/m] at which the ray of `xy` comes closest to that of `xy_S`, both
  // normalized and undistorted: least squares over the epipolar plane.
  double InverseDepth(const Eigen::Vector2d& xy, const Eigen::Vector2d& xy_S) const;

  // Change of a distant point's inverse depth on the optical axis per pixel of disparity [1/m].
  double InverseDepthPerPixel() const;

  // Returns the affine warp between the surroundings of a point in the two images: d(pixel in the
  // second image) / d(pixel in the first image), at a constant inverse depth [1/m] on the ray of
  // `xy`. Returns nullopt if either camera does not observe the point.
  std::optional<Eigen::Matrix2d> Warp(const Eigen::Vector2d& xy, double inverse_depth) const;

  // Samples the epipolar curve within the second image, from one inverse depth [1/m] to a larger
  // one, in steps of about one pixel. The curve ends early if it leaves the second camera's view.
  std::vector<CurvePoint> Curve(const Eigen::Vector2d& xy, double from, double to) const;

  // Returns the pair with the roles exchanged.
  CameraPair Swapped() const {
    return {second_, first_, T_S_C_.Inverse(), {numbers_.second, numbers_.first}};
  }
  // Returns the same cameras with other extrinsics.
  CameraPair With(const Rigid3d& T_S_C) const { return {first_, second_, T_S_C, numbers_}; }

  const CameraModel& first() const { return *first_; }
  const CameraModel& second() const { return *second_; }
  const std::shared_ptr<const CameraModel>& second_camera() const { return second_; }
  const Rigid3d& T_S_C() const { return T_S_C_; }
  const StereoPair& numbers() const { return numbers_; }  // of the cameras

 private:
  void AppendBetween(const CurvePoint& from, const CurvePoint& to, double length_px,
                     std::vector<CurvePoint>* curve) const;

  std::shared_ptr<const CameraModel> first_, second_;
  Rigid3d T_S_C_;
  Eigen::Matrix3d R_S_C_;
  StereoPair numbers_;
};

// Returns two cameras of a configuration. Throws std::invalid_argument as CameraModel::Create()
// does.
CameraPair CameraPairOf(const SensorConfig& sensor, const StereoPair& numbers);

}  // namespace plm_vins
