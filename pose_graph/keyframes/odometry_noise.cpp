// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {

Matrix4d LevelCovariance(const OdometryFrame& frame) {
  Eigen::Matrix<double, 4, 6> J = Eigen::Matrix<double, 4, 6>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<1, 3>() = frame.T_O_B.R().row(2);  // a rotation of B, about z of O
  return J * frame.covariance * J.transpose();
}

Matrix4d StepCovariance(const OdometryNoise& noise, const Keyframe& from, const Keyframe& to) {
  const double length = (to.T_O_B.translation - from.T_O_B.translation).norm();
  const Vector4d growth = (to.covariance - from.covariance).diagonal();
  return growth.cwiseAbs().cwiseMax(noise.Variances(length)).asDiagonal();
}

}  // namespace plm_vins
