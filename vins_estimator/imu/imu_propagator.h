// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "common/imu/imu_gate.h"
#include "common/imu/imu_noise.h"
#include "common/measurements.h"
#include "common/streams/forward_jump.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins {

// The state at IMU rate: takes the latest optimised state forward through the IMU samples after it.
// A new state arrives late, so the newer samples are kept and applied to it again.
//
// It never reaches further than kHorizonSeconds past the optimised state, nor keeps older samples;
// beyond, it says nothing until the next Reset().
class ImuPropagator {
 public:
  static constexpr double kHorizonSeconds = 2.0;

  explicit ImuPropagator(const Eigen::Vector3d& gravity_W, const ImuRange& imu_range = ImuRange());

  // Starts from `state`, valid at `t_imu_ns` of the IMU clock.
  void Reset(const FrameState& state, int64_t t_imu_ns);

  // The state at this sample, its t_ns being the sample's stamp. Nothing without a state to start
  // from (none yet, too old, or newer than the sample) or where the sample is nothing that a sensor
  // gives, out of order, the first after a leap in time, or waits for others to confirm it
  // (ImuGate).
  std::optional<FrameState> Add(const ImuSample& sample);

  // Stamp of the newest sample; nothing without one.
  std::optional<int64_t> newest_ns() const;

  // Forgets the state and the samples.
  void Clear();

 private:
  void Take(const ImuSample& sample);
  // Takes state_ from its own time to that of samples_[index], which closes the interval.
  void Advance(size_t index);

  Eigen::Vector3d gravity_W_;
  std::deque<ImuSample> samples_;    // increasing stamps
  std::optional<FrameState> state_;  // t_ns in IMU time
  int64_t t_reset_ns_ = 0;
  ForwardJumpDetector leap_;
  ImuGate gate_;
  std::optional<int64_t> last_ns_;  // of the newest sample that went to the gate
};

}  // namespace plm_vins
