// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_fix.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

OdometryNoise NoDrift() {
  OdometryNoise noise;
  noise.position_floor = noise.position_rate = noise.yaw_floor = noise.yaw_rate = 0;
  return noise;
}

MapFix FixWith(const Vector4d& variances) {
  MapFix fix;
  fix.T_M_O = {M_PI / 2, {5, 0, 1}};
  fix.T_O_L.translation = {1, 2, 3};
  fix.covariance = variances.asDiagonal();
  fix.drift = NoDrift();
  return fix;
}

TEST(CovarianceInMap, EqualsTheKeyframesAtItsPosition) {
  const MapFix fix = FixWith({0.1, 0.2, 0.3, 0.04});
  const Rigid3d T_O_B(Eigen::Quaterniond::Identity(), fix.T_O_L.translation);
  const Matrix6d covariance = CovarianceInMap(fix, T_O_B, Matrix6d::Zero());
  EXPECT_NEAR((covariance.topLeftCorner<3, 3>() - fix.covariance.topLeftCorner<3, 3>()).norm(), 0,
              1e-12);
  EXPECT_NEAR(covariance(5, 5), 0.04, 1e-12);
}

TEST(CovarianceInMap, AddsTheDriftSinceTheKeyframe) {
  MapFix fix = FixWith(Vector4d::Zero());
  fix.odometry_covariance = Vector4d(1, 1, 1, 0.5).asDiagonal();
  Matrix6d covariance = Matrix6d::Identity();
  covariance(0, 0) = 1.25;  // of x in O, which is y in M
  const Rigid3d T_O_B(Eigen::Quaterniond::Identity(), fix.T_O_L.translation);
  const Matrix6d in_map = CovarianceInMap(fix, T_O_B, covariance);
  EXPECT_NEAR(in_map(0, 0), 0, 1e-12);
  EXPECT_NEAR(in_map(1, 1), 0.25, 1e-12);
  EXPECT_NEAR(in_map(5, 5), 0.5, 1e-12);
}

TEST(CovarianceInMap, AddsTheLeverArmOfTheKeyframesRotation) {
  const MapFix fix = FixWith({0, 0, 0, 0.01});
  const Rigid3d T_O_B(Eigen::Quaterniond::Identity(),
                      fix.T_O_L.translation + Eigen::Vector3d(2, 0, 0));  // along y of M
  const Matrix6d covariance = CovarianceInMap(fix, T_O_B, Matrix6d::Zero());
  EXPECT_NEAR(covariance(0, 0), 4 * 0.01, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0, 1e-12);
  EXPECT_NEAR(covariance(0, 5), -2 * 0.01, 1e-12);
}

// The map determines the heading about the vertical, odometry the other directions, at any
// attitude.
TEST(CovarianceInMap, KeepsRollAndPitchOfATiltedBody) {
  MapFix fix = FixWith({0, 0, 0, 0.01});
  const Rigid3d T_O_B(
      Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, -1).normalized())),
      fix.T_O_L.translation);
  Matrix6d covariance = Matrix6d::Zero();
  covariance.bottomRightCorner<3, 3>().diagonal() << 0.002, 0.004, 0.003;
  fix.odometry_covariance = LevelCovariance(T_O_B, covariance);
  const Matrix6d in_map = CovarianceInMap(fix, T_O_B, covariance);
  const Eigen::Matrix3d R_O_B = T_O_B.R();
  const Eigen::Matrix3d before = R_O_B * covariance.bottomRightCorner<3, 3>() * R_O_B.transpose();
  const Eigen::Matrix3d after = R_O_B * in_map.bottomRightCorner<3, 3>() * R_O_B.transpose();
  EXPECT_NEAR((after - before).topLeftCorner(2, 2).norm(), 0, 1e-12);
  EXPECT_NEAR(after(2, 2), 0.01, 1e-12);
}

}  // namespace
}  // namespace plm_vins
