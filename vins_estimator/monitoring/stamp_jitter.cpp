// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/stamp_jitter.h"

#include <cmath>

#include "common/statistics.h"

namespace plm_vins {
namespace {

constexpr double kJitterForgetting = 0.02;  // per image: 2.5 s at 20 Hz
constexpr double kMinRatio = 4.0;       // ratio of the variances along and across the rotation axis
constexpr double kMinDeviation = 1e-3;  // [s]
// Sum of products of two squared rates [rad^4/s^4]: jitter is unobservable without rotation.
constexpr double kMinSquaredRates = 1e-2;

// Returns the time derivative of a state, in the frame of R_B_W [per second].
Vector15d Change(const Eigen::Matrix3d& R_B_W, const FrameState& state, const ImuSample& sample,
                 const Eigen::Vector3d& gravity_W) {
  const Eigen::Vector3d accel_W =
      state.rotation() * (sample.accel - state.accel_bias()) + gravity_W;
  Vector15d change = Vector15d::Zero();
  change.segment<3>(ImuErrorIndex::kPosition) = R_B_W * state.velocity();
  change.segment<3>(ImuErrorIndex::kRotation) = sample.gyro - state.gyro_bias();
  change.segment<3>(ImuErrorIndex::kVelocity) = R_B_W * accel_W;
  return change;
}

}  // namespace

void StampJitterMonitor::Add(const Eigen::Vector3d& rotation_residual,
                             const Eigen::Vector3d& rate) {
  const double along = rate.dot(rotation_residual), squared_rate = rate.squaredNorm();
  AddForgetting(kJitterForgetting, along * along, &along_);
  AddForgetting(kJitterForgetting, squared_rate * rotation_residual.squaredNorm() - along * along,
                &across_);
  AddForgetting(kJitterForgetting, along * along_before_, &common_);
  AddForgetting(kJitterForgetting, squared_rate * squared_rate_before_, &squared_rates_);
  along_before_ = along;
  squared_rate_before_ = squared_rate;
}

void StampJitterMonitor::Skip() { along_before_ = squared_rate_before_ = 0; }

// There are two directions across the rotation axis, hence the division by two.
double StampJitterMonitor::deviation() const {
  if (squared_rates_ < kMinSquaredRates || along_ < kMinRatio * across_ / 2 || common_ >= 0)
    return 0;
  const double deviation = std::sqrt(-common_ / squared_rates_);
  return deviation > kMinDeviation ? deviation : 0;
}

StampErrors StampErrorsOf(double deviation, const Preintegration& motion,
                          const Eigen::Vector3d& gravity_W, const FrameState& start,
                          const FrameState& end) {
  const Eigen::Matrix3d R_B_W = start.rotation().toRotationMatrix().transpose();
  return {deviation * Change(R_B_W, start, motion.samples().front(), gravity_W),
          deviation * Change(R_B_W, end, motion.samples().back(), gravity_W)};
}

}  // namespace plm_vins
