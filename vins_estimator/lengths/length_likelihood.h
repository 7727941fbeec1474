// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry/rigid3.h"
#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/lengths/ratio_curve.h"

namespace plm_vins {

// Path of a camera in stated lengths, as stereo odometry finds it, in any frame G.
struct StatedPath {
  std::vector<Eigen::Vector3d> p_G_C;
  std::vector<Eigen::Matrix3d> covariance;  // of each position
};

// Motion along a path as the IMU measured it, in a frame G in which the path is given as well.
struct MeasuredMotion {
  std::vector<const Preintegration*> intervals;  // interval i is from view i to view i + 1
  Eigen::Quaterniond R_G_B0;                     // at the first view
  Rigid3d T_B_C;
};

// Standard deviations of what the path does not tell, and gravity.
struct MotionPrior {
  double gravity_norm;          // [m/s^2]
  double accel_bias_deviation;  // about 0 [m/s^2]
  double gyro_bias_deviation;   // about the linearization bias of the intervals [rad/s]
};

// Returns the log-likelihood of the ratio r of stated to true lengths. The IMU predicts the path in
// true lengths up to start, velocity and a constant acceleration (inclination and bias), which may
// be anything; r times that is the stated path. With mean mu and covariance A of the prediction and
// covariance B of the stated path,
//   q ~ N(r mu, r^2 A + B).
// In motion without acceleration, or at standstill, all ratios are about equally likely. If the
// residuals at the most likely ratio exceed the noise, the curve is flattened accordingly. Returns
// nullopt if the covariances are degenerate.
std::optional<RatioCurve> LikelihoodOfRatio(const StatedPath& path, const MeasuredMotion& motion,
                                            const MotionPrior& prior);

}  // namespace plm_vins
