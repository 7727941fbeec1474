// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/static_initializer.h"

#include <cmath>

#include "common/format.h"
#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

constexpr double kMaxGyroMean = 0.5;      // larger values are no bias [rad/s]
constexpr double kMaxGravityError = 1.0;  // error of the norm of the mean specific force [m/s^2]

Eigen::Vector3d MeanSpecificForce(const std::vector<ImuSample>& samples) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : samples) mean += sample.accel / samples.size();
  return mean;
}

}  // namespace

double ExcessOfGravity(const std::vector<ImuSample>& samples, double gravity_norm) {
  return MeanSpecificForce(samples).norm() - gravity_norm;
}

std::optional<FrameState> InitializeFromStandstill(const std::vector<ImuSample>& samples,
                                                   double gravity_norm, std::string* reason) {
  const Eigen::Vector3d accel = MeanSpecificForce(samples);
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : samples) gyro += sample.gyro / samples.size();
  if (!(std::abs(accel.norm() - gravity_norm) < kMaxGravityError)) {
    *reason = Format("standing still, but gravity reads %.2f m/s^2 instead of %.2f", accel.norm(),
                     gravity_norm);
    return std::nullopt;
  }
  if (!(gyro.norm() < kMaxGyroMean)) {
    *reason = Format("standing still, but the gyro reads %.2f rad/s", gyro.norm());
    return std::nullopt;
  }
  const Eigen::Quaterniond R_W_B = ShortestRotation(accel, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd heading(-Yaw(R_W_B), Eigen::Vector3d::UnitZ());
  FrameState state;
  state.SetPose({heading * R_W_B, Eigen::Vector3d::Zero()});
  state.SetBias({Eigen::Vector3d::Zero(), gyro});
  return state;
}

}  // namespace plm_vins
