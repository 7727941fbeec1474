// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/initial_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/simulated_window.h"

namespace plm_vins {
namespace {

using Eigen::MatrixXd;
using testing::SimulatedWindow;

TEST(InitialPrior, IsTheStatedUncertaintyOfTheFirstState) {
  SimulatedWindow simulated = testing::SimulateWindow(2);
  const InitialUncertainty uncertainty;
  ProblemOptions options = testing::OnePixelOptions();
  const MarginalizationPrior prior = InitialPrior(uncertainty, options, simulated.window);
  const MatrixXd covariance = prior.quadratic().H.inverse();
  ASSERT_EQ(covariance.rows(), 15);
  EXPECT_TRUE(prior.quadratic().b.isZero(0));
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), uncertainty.position, 1e-9);
  const Eigen::Matrix3d R_W_B = simulated.window.frames[0].state.T_W_B().R();
  const Eigen::Matrix3d in_world = R_W_B * covariance.block<3, 3>(3, 3) * R_W_B.transpose();
  EXPECT_NEAR(std::sqrt(in_world(0, 0)), uncertainty.inclination, 1e-9);
  EXPECT_NEAR(std::sqrt(in_world(2, 2)), uncertainty.heading, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(8, 8)), uncertainty.velocity, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(11, 11)), uncertainty.accel_bias, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(14, 14)), uncertainty.gyro_bias, 1e-9);

  options.estimate_extrinsic = options.estimate_td = options.estimate_intrinsics = true;
  const MarginalizationPrior all = InitialPrior(uncertainty, options, simulated.window);
  const MatrixXd all_covariance = all.quadratic().H.inverse();
  ASSERT_EQ(all_covariance.rows(), 30);
  EXPECT_NEAR(std::sqrt(all_covariance(20, 20)), uncertainty.extrinsic_rotation, 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(21, 21)), uncertainty.td, 1e-9);
  const Intrinsics& intrinsics = simulated.window.cameras[0].intrinsics;
  const IntrinsicsDeviation& deviation = uncertainty.intrinsics;
  EXPECT_NEAR(std::sqrt(all_covariance(22, 22)), deviation.focal_length * intrinsics[0], 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(23, 23)), deviation.focal_length * intrinsics[1], 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(25, 25)), deviation.principal_point, 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(26, 26)), deviation.distortion, 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(29, 29)), deviation.distortion, 1e-9);
}

// The mean specific force levels the state: an error of the accelerometer bias tilts it.
TEST(InitialPrior, CorrelatesTiltAndAccelerometerBiasAtStandstill) {
  const SimulatedWindow simulated = testing::SimulateWindow(2);
  const FrameState& state = simulated.window.frames[0].state;
  const double gravity = simulated.window.gravity_W.norm();
  InitialUncertainty uncertainty;
  uncertainty.accel_bias = 0.5;
  uncertainty.leveled_by = 0.02;
  const MatrixXd covariance =
      InitialPrior(uncertainty, testing::OnePixelOptions(), simulated.window)
          .quadratic()
          .H.inverse();
  const Eigen::Matrix3d R_W_B = state.T_W_B().R();
  const Eigen::Matrix3d tilt_W = R_W_B * covariance.block<3, 3>(3, 3) * R_W_B.transpose();
  EXPECT_NEAR(std::sqrt(tilt_W(0, 0)), std::hypot(0.5, 0.02) / gravity, 1e-6);
  EXPECT_NEAR(std::sqrt(tilt_W(2, 2)), uncertainty.heading, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(9, 9)), 0.5, 1e-9);

  // For each tilt, the bias is known to `leveled_by`.
  const auto mean_force = [&](const Eigen::Vector3d& tilt, const Eigen::Vector3d& bias) {
    const Eigen::Quaterniond R_B_W = (state.rotation() * SO3Exp(tilt)).conjugate();
    return Eigen::Vector3d(bias + R_B_W * Eigen::Vector3d(0, 0, gravity));
  };
  const Eigen::Vector3d horizontal_B = state.rotation().conjugate() * Eigen::Vector3d::UnitX();
  MatrixXd d_force(3, 6);
  d_force << testing::NumericJacobian(
      [&](const Eigen::Vector3d& tilt) { return mean_force(tilt, Eigen::Vector3d::Zero()); },
      Eigen::Vector3d(Eigen::Vector3d::Zero())),
      MatrixXd::Identity(3, 3);
  MatrixXd of_both(6, 6);
  of_both << covariance.block<3, 3>(3, 3), covariance.block<3, 3>(3, 9),
      covariance.block<3, 3>(9, 3), covariance.block<3, 3>(9, 9);
  const double variance = horizontal_B.dot(d_force * of_both * d_force.transpose() * horizontal_B);
  EXPECT_NEAR(std::sqrt(variance), 0.02, 1e-6);
}

TEST(InitialPrior, HoldsTheIntrinsicsOfEachCamera) {
  SimulatedWindow simulated = testing::SimulateWindow(2);
  simulated.window.cameras.push_back(simulated.window.cameras[0]);
  ProblemOptions options = testing::OnePixelOptions();
  options.estimate_intrinsics = true;
  const MatrixXd covariance =
      InitialPrior(InitialUncertainty(), options, simulated.window).quadratic().H.inverse();
  ASSERT_EQ(covariance.rows(), 15 + 2 * kIntrinsicsSize);
  EXPECT_MATRIX_NEAR(covariance.diagonal().tail<kIntrinsicsSize>(),
                     covariance.diagonal().segment<kIntrinsicsSize>(15), 1e-12);
}

TEST(InitialPrior, HoldsTheCalibrationOfADepthStream) {
  const SimulatedWindow simulated = testing::SimulateWindow(2);
  ProblemOptions options = testing::OnePixelOptions();
  options.estimate_depth_stream = true;
  const InitialUncertainty uncertainty;
  const MatrixXd covariance =
      InitialPrior(uncertainty, options, simulated.window).quadratic().H.inverse();
  ASSERT_EQ(covariance.rows(), 15 + kDepthStreamSize);
  EXPECT_NEAR(std::sqrt(covariance(15, 15)), uncertainty.depth_scale, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(16, 16)), uncertainty.depth_delay, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(18, 18)), uncertainty.depth_shift, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(19, 19)), uncertainty.depth_zoom, 1e-9);
}

}  // namespace
}  // namespace plm_vins
