// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/imu_propagator.h"

#include "common/imu/imu_samples.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {
namespace {

const int64_t kHorizon_ns = ToNanoseconds(ImuPropagator::kHorizonSeconds);

}  // namespace

ImuPropagator::ImuPropagator(const Eigen::Vector3d& gravity_W, const ImuSensor& imu)
    : gravity_W_(gravity_W), door_(imu) {}

void ImuPropagator::Reset(const FrameState& state, int64_t t_imu_ns) {
  state_ = state;
  state_->t_ns = t_imu_ns;
  t_reset_ns_ = t_imu_ns;
  // Keeps the last sample at or before the state, from which the first interval is interpolated.
  while (samples_.size() > 1 && samples_[1].t_ns <= t_imu_ns) samples_.pop_front();
  for (size_t i = 0; i < samples_.size(); ++i) Advance(i);
}

std::optional<FrameState> ImuPropagator::Add(const ImuSample& sample) {
  const AdmittedImu admitted = door_.Add(sample);
  if (admitted.clock != ClockChange::kNone) Forget();
  for (const ImuSample& next : admitted.samples) Take(next);
  const bool reaches_sample =
      state_ && !admitted.samples.empty() && state_->t_ns == admitted.samples.back().t_ns;
  return reaches_sample ? state_ : std::nullopt;
}

void ImuPropagator::Take(const ImuSample& sample) {
  samples_.push_back(sample);
  while (samples_.front().t_ns < sample.t_ns - kHorizon_ns) samples_.pop_front();
  if (state_ && sample.t_ns > t_reset_ns_ + kHorizon_ns) state_.reset();
  if (state_) Advance(samples_.size() - 1);
}

void ImuPropagator::Clear() {
  door_.Clear();
  Forget();
}

void ImuPropagator::Forget() {
  samples_.clear();
  state_.reset();
}

void ImuPropagator::Advance(size_t index) {
  const ImuSample& end = samples_[index];
  if (end.t_ns <= state_->t_ns) return;
  // If there is no sample before the state, the first one is assumed constant back to its time.
  ImuSample begin = end;
  begin.t_ns = state_->t_ns;
  if (index > 0) begin = InterpolateImu(samples_[index - 1], end, state_->t_ns);

  Preintegration interval(ImuNoise(), state_->bias());  // the noise is not used here
  interval.Append(begin);
  interval.Append(end);
  *state_ = interval.Predict(*state_, gravity_W_);
}

}  // namespace plm_vins
