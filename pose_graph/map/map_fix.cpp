// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_fix.h"

#include "pose_graph/graph/level_edge.h"

namespace plm_vins {

Matrix4d LevelCovarianceInMap(const MapFix& fix, const Eigen::Vector3d& p_O,
                              const Matrix4d& odometry_covariance) {
  LevelEdge place;
  place.T_from_to = fix.T_M_O * fix.T_O_L;
  place.covariance = fix.covariance;
  LevelEdge since;
  since.T_from_to = fix.T_O_L.Inverse() * LevelTransform{0, p_O};
  since.covariance = StepCovariance(fix.drift, since.T_from_to.translation,
                                    odometry_covariance - fix.odometry_covariance);
  return Chained(place, since).covariance;
}

Eigen::Matrix<double, 6, 6> CovarianceInMap(
    const MapFix& fix, const Rigid3d& T_O_B,
    const Eigen::Matrix<double, 6, 6>& odometry_covariance) {
  const Eigen::Vector3d up_B = T_O_B.R().row(2);
  Eigen::Matrix<double, 6, 4> J = Eigen::Matrix<double, 6, 4>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<3, 1>() = up_B;
  const Matrix4d level =
      LevelCovarianceInMap(fix, T_O_B.translation, LevelCovariance(T_O_B, odometry_covariance));
  Eigen::Matrix<double, 6, 6> result = J * level * J.transpose();
  const Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity() - up_B * up_B.transpose();
  result.bottomRightCorner<3, 3>() += tilt * odometry_covariance.bottomRightCorner<3, 3>() * tilt;
  return result;
}

}  // namespace plm_vins
