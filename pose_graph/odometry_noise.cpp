// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/odometry_noise.h"

#include <algorithm>

namespace plm_vins {
namespace {

// Variances of (x, y, z, yaw) in O.
Vector4d Variances(const OdometryFrame& frame) {
  const Eigen::Matrix3d R_O_B = frame.T_O_B.R();
  const Eigen::Matrix3d rotation_O =
      R_O_B * frame.covariance.bottomRightCorner<3, 3>() * R_O_B.transpose();
  Vector4d variances;
  variances << frame.covariance.diagonal().head<3>(), rotation_O(2, 2);
  return variances;
}

}  // namespace

Matrix4d StepCovariance(const OdometryNoise& noise, const OdometryFrame& from,
                        const OdometryFrame& to) {
  const double length = (to.T_O_B.translation - from.T_O_B.translation).norm();
  const Vector4d growth = Variances(to) - Variances(from);
  return growth.cwiseMax(noise.Variances(length)).asDiagonal();
}

}  // namespace plm_vins
