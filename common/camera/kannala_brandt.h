// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/camera/camera_model.h"

namespace plm_vins {

// Fisheye camera [Kannala2006], "equidistant" in Kalibr, cv::fisheye in OpenCV: a ray at angle
// theta to the optical axis projects to distance theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3
// theta^6 + k4 theta^8) from the center. Rays behind the camera are projected too, as long as
// theta_d increases with theta.
class KannalaBrandt final : public CameraModel {
 public:
  explicit KannalaBrandt(const CameraParameters& parameters);

  std::optional<Eigen::Vector2d> Project(
      const Eigen::Vector3d& p_C, Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const override;
  std::optional<Eigen::Vector2d> Unproject(const Eigen::Vector2d& pixel,
                                           Eigen::Matrix2d* d_xy_d_pixel) const override;
  double FocalLength() const override;

 private:
  Eigen::Matrix<double, 2, 4> PlaneByDistortion(const Eigen::Vector2d& xy) const override;
  double Distort(double theta) const;            // theta_d [rad]
  double DistortDerivative(double theta) const;  // d theta_d / d theta
  double FindMaxTheta() const;
  double Undistort(double theta_d) const;  // for theta_d < Distort(max_theta_)

  Eigen::Vector4d k_;
  double max_theta_;  // theta_d increases up to here; at most pi [rad]
};

}  // namespace plm_vins
