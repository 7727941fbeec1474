// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/motion_terms.h"

#include <algorithm>
#include <cstdint>

#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/zero_velocity_factor.h"

namespace plm_vins {
namespace {

constexpr double kUnknownDepth = 10;  // [m], of a scene at standstill: rather too large

}  // namespace

void MotionTerms::Add(size_t index) {
  const WindowFrame& from = window_->frames[index - 1];
  const WindowFrame& to = window_->frames[index];
  const int64_t from_ns = from.state.t_ns, to_ns = to.state.t_ns;
  const int pose_i = variables_->Pose(from_ns), motion_i = variables_->Motion(from_ns);
  const int pose_j = variables_->Pose(to_ns), motion_j = variables_->Motion(to_ns);
  problem_->AddTerm(ImuFactor(to.motion_since_previous.get(), window_->gravity_W), nullptr,
                    {pose_i, motion_i, pose_j, motion_j});
  if (!to.stationary) return;
  const double interval = ToSeconds(to_ns - from_ns);
  const double passing_velocity =
      std::max(options_->passing_velocity, to.flow_at_rest * kUnknownDepth);
  const double turn_rate = std::max(options_->passing_turn_rate, to.flow_at_rest);
  const double velocity = std::max(options_->standstill_velocity, passing_velocity);
  const double position = std::max(options_->standstill_position, passing_velocity * interval);
  const double rotation = std::max(options_->standstill_rotation, turn_rate * interval);
  problem_->AddTerm(ZeroVelocityFactor(velocity), nullptr, {motion_j});
  problem_->AddTerm(SamePoseFactor(position, rotation), nullptr, {pose_i, pose_j});
}

}  // namespace plm_vins
