// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/body_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Matrix6d = BodyOdometry::Matrix6d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Eigen::Quaterniond About(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180, axis));
}

// An IMU with x forward, y right, z down, as in flight controllers, 0.1 m ahead of the base.
const Rigid3d kImuToBase{About(Eigen::Vector3d::UnitX(), 180), {-0.1, 0, 0}};

BodyOdometry Flying() {
  BodyOdometry odometry;
  odometry.T_W_B = {About({0.6, 0, 0.8}, 50), {1, 2, 3}};
  odometry.v_B = {0.5, -1, 2};
  odometry.omega_B = {0.3, 0.2, -0.4};
  Matrix6d L;
  for (int i = 0; i < L.size(); ++i) L(i) = std::sin(1.0 + i);
  odometry.pose_covariance = 1e-3 * L * L.transpose();
  odometry.twist_covariance = 1e-3 * L.transpose() * L;
  return odometry;
}

TEST(BodyOdometry, RotatesAnImuWithZDownToABaseWithZUp) {
  BodyOdometry imu;  // heads along the world's y (north, were the world ENU), level
  imu.T_W_B = {About(Eigen::Vector3d::UnitZ(), 90) * About(Eigen::Vector3d::UnitX(), 180),
               {5, 6, 7}};
  imu.v_B = {1, 0.2, -0.3};       // forward, right, up
  imu.omega_B = {0.0, 0.0, 0.5};  // rotates to the right
  const BodyOdometry base = MoveTo(kImuToBase, imu);
  EXPECT_MATRIX_NEAR(base.T_W_B.translation, Eigen::Vector3d(5, 5.9, 7), 1e-12);
  EXPECT_MATRIX_NEAR(base.T_W_B.R(), About(Eigen::Vector3d::UnitZ(), 90).toRotationMatrix(), 1e-12);
  EXPECT_MATRIX_NEAR(base.omega_B, Eigen::Vector3d(0, 0, -0.5), 1e-12);
  // Forward, left, up; the base is behind the IMU, so a rotation to the right moves it to the left.
  EXPECT_MATRIX_NEAR(base.v_B, Eigen::Vector3d(1, -0.2 + 0.05, 0.3), 1e-12);
}

TEST(BodyOdometry, VelocityIsOfTheBaseOrigin) {
  const BodyOdometry imu = Flying();
  constexpr double kStep = 1e-6;  // [s]
  const auto origin = [&](double t) {
    const Rigid3d T_W_B{imu.T_W_B.rotation * SO3Exp(t * imu.omega_B),
                        imu.T_W_B.translation + t * (imu.T_W_B.rotation * imu.v_B)};
    return Eigen::Vector3d((T_W_B * kImuToBase).translation);
  };
  const BodyOdometry base = MoveTo(kImuToBase, imu);
  EXPECT_MATRIX_NEAR(base.T_W_B.rotation * base.v_B, (origin(kStep) - origin(-kStep)) / (2 * kStep),
                     1e-8);
}

// Draws errors in the order of the message: x, y, z, rotation about x, y, z.
TEST(BodyOdometry, CovariancesFollowTheFrames) {
  const BodyOdometry imu = Flying();
  const BodyOdometry base = MoveTo(kImuToBase, imu);
  const auto pose_error = [&](const Vector6d& error) {
    BodyOdometry moved = imu;
    moved.T_W_B = {SO3Exp(error.tail<3>()) * imu.T_W_B.rotation,
                   imu.T_W_B.translation + error.head<3>()};
    const Rigid3d T_W_base = MoveTo(kImuToBase, moved).T_W_B;
    Eigen::VectorXd result(6);
    result << T_W_base.translation, SO3Log(T_W_base.rotation * base.T_W_B.rotation.conjugate());
    return result;
  };
  const auto twist = [&](const Vector6d& error) {
    BodyOdometry moved = imu;
    moved.v_B += error.head<3>();
    moved.omega_B += error.tail<3>();
    moved = MoveTo(kImuToBase, moved);
    Eigen::VectorXd result(6);
    result << moved.v_B, moved.omega_B;
    return result;
  };
  const Vector6d no_error = Vector6d::Zero();
  const Eigen::MatrixXd J_pose = testing::NumericJacobian(pose_error, no_error);
  const Eigen::MatrixXd J_twist = testing::NumericJacobian(twist, no_error);
  EXPECT_MATRIX_NEAR(base.pose_covariance, J_pose * imu.pose_covariance * J_pose.transpose(), 1e-9);
  EXPECT_MATRIX_NEAR(base.twist_covariance, J_twist * imu.twist_covariance * J_twist.transpose(),
                     1e-9);
}

// The variance to the right of an IMU with z down is that to the left of the base.
TEST(BodyOdometry, VariancesKeepTheirAxes) {
  BodyOdometry imu;
  imu.pose_covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  imu.twist_covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  imu.twist_covariance(0, 1) = imu.twist_covariance(1, 0) = 0.5;
  const BodyOdometry base = MoveTo({About(Eigen::Vector3d::UnitX(), 180), {0, 0, 0}}, imu);
  EXPECT_MATRIX_NEAR(base.pose_covariance, imu.pose_covariance, 1e-12);  // in the world
  EXPECT_MATRIX_NEAR(base.twist_covariance.diagonal(), imu.twist_covariance.diagonal(), 1e-12);
  EXPECT_NEAR(base.twist_covariance(0, 1), -0.5, 1e-12);
}

TEST(BodyOdometry, DetectsUnusableStates) {
  EXPECT_TRUE(Flying().IsUsable());
  BodyOdometry bad = Flying();
  bad.twist_covariance(5, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(bad.IsUsable());
  bad = Flying();
  bad.T_W_B.translation.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(bad.IsUsable());
  bad = Flying();
  bad.T_W_B.rotation.coeffs().setZero();  // as in an uninitialized message
  EXPECT_FALSE(bad.IsUsable());
}

}  // namespace
}  // namespace plm_vins
