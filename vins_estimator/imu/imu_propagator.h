// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "common/imu/imu_door.h"
#include "common/measurements.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// Propagates the latest optimized state at IMU rate. Optimized states arrive late, so newer samples
// are stored and applied again.
//
// It propagates at most kHorizonSeconds past the optimized state and stores no older samples; after
// that it returns nullopt until the next Reset().
class ImuPropagator {
 public:
  static constexpr double kHorizonSeconds = 2.0;

  explicit ImuPropagator(const Eigen::Vector3d& gravity_W, const ImuSensor& imu = ImuSensor());

  // Restarts from `state`, valid at `t_imu_ns` of the IMU clock.
  void Reset(const FrameState& state, int64_t t_imu_ns);

  // Returns the state at this sample, with t_ns in IMU time. Returns nullopt if there is no state
  // to start from (none yet, too old, newer than the sample, or of another clock), or if the sample
  // is unusable or still undecided (ImuDoor).
  std::optional<FrameState> Add(const ImuSample& sample);

  // Returns the angular velocity of B in B at the newest sample [rad/s]; there must be a state.
  Eigen::Vector3d AngularVelocity() const { return samples_.back().gyro - state_->gyro_bias(); }

  // Returns the time of the newest sample; nullopt if there is none.
  std::optional<int64_t> newest_ns() const {
    return samples_.empty() ? std::nullopt : std::optional(samples_.back().t_ns);
  }

  // Drops the state and the samples.
  void Clear();

 private:
  void Forget();
  void Take(const ImuSample& sample);
  // Propagates state_ from its own time to that of samples_[index], the end of the interval.
  void Advance(size_t index);

  Eigen::Vector3d gravity_W_;
  std::deque<ImuSample> samples_;    // ordered by time
  std::optional<FrameState> state_;  // t_ns in IMU time
  int64_t t_reset_ns_ = 0;
  ImuDoor door_;
};

}  // namespace plm_vins
