// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/odometry_noise.h"

namespace plm_vins {

Matrix4d LevelCovariance(const Rigid3d& T_O_B, const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 4, 6> J = Eigen::Matrix<double, 4, 6>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<1, 3>() = T_O_B.R().row(2);  // yaw about z of O, from a rotation in B
  return J * covariance * J.transpose();
}

Matrix4d StepCovariance(const OdometryNoise& noise, const Eigen::Vector3d& way,
                        const Matrix4d& growth) {
  return growth.diagonal().cwiseAbs().cwiseMax(noise.Variances(way.norm())).asDiagonal();
}

}  // namespace plm_vins
