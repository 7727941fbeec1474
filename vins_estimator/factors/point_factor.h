// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

namespace plm_vins {

// One corner in one image, moved along its velocity v to the time that the frame's state stands
// for: the state was cut at t_image + cut_time_offset, the image was taken at t_image + td, so at
// the state's time the corner is at xy - (td - cut_time_offset) v.
struct TimedBearing {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalised, undistorted
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [1/s]
  double cut_time_offset = 0;                          // [s]

  Eigen::Vector2d At(double td) const { return xy - (td - cut_time_offset) * velocity; }
};

// A point is given by its normalised image point and inverse depth in a host camera, (x, y, lambda
// [1/m]):
//   p_Ch = (x, y, 1) / lambda   ([Civera2008], with the host's own noise estimated as well).
constexpr int kPointSize = 3;

// Position in the host camera [m].
inline Eigen::Vector3d PointInHost(const double* point) {
  return Eigen::Vector3d(point[0], point[1], 1.0) / point[2];
}

// Reprojection of a point into a frame other than its host:
//   r = weight * ( pi(T_B_C^-1 T_W_Bt^-1 T_W_Bh T_B_C p_Ch) - m_t(td) )
// Blocks: pose of host (7), pose of target (7), extrinsics T_B_C (7), time offset td (1), point
// (3). Jacobians follow factors/manifolds.h. Evaluate() fails where the point is not in front of
// the target.
class PointFactor final : public ceres::SizedCostFunction<2, 7, 7, 7, 1, kPointSize> {
 public:
  // `weight`: focal length over the standard deviation of a corner, both in pixels.
  PointFactor(const TimedBearing& target, double weight) : target_(target), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing target_;
  double weight_;
};

// The host's own view: r = weight * ( (x, y) - m_h(td) ). Blocks: time offset td (1), point (3).
class PointHostFactor final : public ceres::SizedCostFunction<2, 1, kPointSize> {
 public:
  PointHostFactor(const TimedBearing& host, double weight) : host_(host), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  TimedBearing host_;
  double weight_;
};

}  // namespace plm_vins
