// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/camera/camera_model.h"
#include "vins_estimator/factors/factor.h"
#include "vins_estimator/factors/line_factor.h"
#include "vins_estimator/factors/point_factor.h"

namespace plm_vins {

// Shift of an observed ray by the camera intrinsics c, linearized at the intrinsics with which the
// ray was computed: d_xy_d_intrinsics (c - reference), normalized.
struct RayShift {
  // For a ray (x, y, 1) of `camera`; the shift is zero outside the range of the camera model.
  RayShift(const CameraModel& camera, const Eigen::Vector2d& xy)
      : reference(camera.parameters().intrinsics()),
        d_xy_d_intrinsics(camera.RayByIntrinsics(xy).value_or(IntrinsicsJacobian::Zero())) {}

  Eigen::Vector2d At(const double* intrinsics) const {
    return d_xy_d_intrinsics * (Eigen::Map<const Intrinsics>(intrinsics) - reference);
  }

  Intrinsics reference;
  IntrinsicsJacobian d_xy_d_intrinsics;
};

// Extends a PointFactor by the intrinsics c of the observing camera as a variable: the corner is
// observed at xy + shift(c), which the residual weight * (m_t - xy) depends on directly. Blocks:
// those of the inner factor, intrinsics (8).
class PointIntrinsicsFactor final : public Factor {
 public:
  PointIntrinsicsFactor(const PointFactor& factor, const RayShift& shift)
      : Factor(2, factor.num_blocks() + 1), factor_(factor), shift_(shift) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PointFactor factor_;
  RayShift shift_;
};

// Extends a LineFactor by the intrinsics c of the observing camera: the ends of the segment are
// observed at xy + shift(c). Blocks: those of the inner factor, intrinsics (8).
class LineIntrinsicsFactor final : public Factor {
 public:
  LineIntrinsicsFactor(const LineFactor& factor, const RayShift& start_shift,
                       const RayShift& end_shift)
      : Factor(2, factor.num_blocks() + 1),
        factor_(factor),
        start_shift_(start_shift),
        end_shift_(end_shift) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  LineFactor factor_;
  RayShift start_shift_, end_shift_;
};

}  // namespace plm_vins
