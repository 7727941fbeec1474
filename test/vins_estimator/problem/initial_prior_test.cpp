// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/initial_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

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
  const Intrinsics& intrinsics = simulated.window.intrinsics;
  const IntrinsicsDeviation& deviation = uncertainty.intrinsics;
  EXPECT_NEAR(std::sqrt(all_covariance(22, 22)), deviation.focal_length * intrinsics[0], 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(23, 23)), deviation.focal_length * intrinsics[1], 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(25, 25)), deviation.principal_point, 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(26, 26)), deviation.distortion, 1e-9);
  EXPECT_NEAR(std::sqrt(all_covariance(29, 29)), deviation.distortion, 1e-9);
}

TEST(InitialPrior, HoldsTheSecondCamera) {
  SimulatedWindow simulated = testing::SimulateWindow(2);
  simulated.window.SetMounting({Eigen::Quaterniond::Identity(), {0.1, 0, 0}});
  ProblemOptions options = testing::OnePixelOptions();
  options.estimate_mounting = true;
  const InitialUncertainty uncertainty;
  const MatrixXd covariance =
      InitialPrior(uncertainty, options, simulated.window).quadratic().H.inverse();
  ASSERT_EQ(covariance.rows(), 21);
  EXPECT_NEAR(std::sqrt(covariance(16, 16)), uncertainty.mounting, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(17, 17)), uncertainty.baseline, 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(20, 20)), uncertainty.mounting, 1e-9);
}

}  // namespace
}  // namespace plm_vins
