// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_door.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/format.h"
#include "common/imu/imu_samples.h"
#include "common/imu/imu_sensor.h"

namespace plm_vins {
namespace {

constexpr int64_t kMaxStep_ns = 60'000'000'000;  // no propagation bridges a longer one
constexpr int64_t kRecent_ns = 1'000'000'000;

constexpr int64_t kManyChanges = 100;      // of a sensor that has noise
constexpr double kGravity = 9.81;          // [m/s^2]
constexpr double kMaxForceStanding = 0.5;  // beside gravity [m/s^2]

bool MayStand(const ImuSample& sample) {
  return sample.gyro.norm() < kMostStandingRate &&
         std::abs(sample.accel.norm() - kGravity) < kMaxForceStanding;
}

bool AreAlike(const ImuSample& a, const ImuSample& b) {
  return a.gyro == b.gyro && a.accel == b.accel;
}

}  // namespace

AdmittedImu ImuDoor::Add(const ImuSample& raw) {
  AdmittedImu admitted;
  const ImuSample sample = bursts_.Spread(raw);
  if (!IsReading(sample) || IsStuck(sample)) return admitted;
  const bool follows = recent_.empty() || sample.t_ns > recent_.back().t_ns;
  if (!follows) {
    ++statistics_.imu_out_of_order;
    // A duplicate is no evidence of a clock change, unless samples before it were rejected: then a
    // recording is played again.
    if (!jump_.HasRejected() && IsRepeated(sample)) return admitted;
  }
  const bool set_back = follows ? jump_.EndsStepBack(sample.t_ns) : jump_.Reject(sample.t_ns);
  if (!follows && !set_back) return admitted;
  if (set_back) {
    Clear();
    admitted.clock = ClockChange::kBack;
  }
  jump_.Accept();
  DecideAfterGap(sample.t_ns, &admitted);
  if (!recent_.empty() && IsGap(recent_.back().t_ns, sample.t_ns)) {
    after_gap_ = sample;
  } else {
    Take(sample, &admitted);
  }
  return admitted;
}

bool ImuDoor::IsReading(const ImuSample& sample) {
  if (IsPlausible(sample)) return true;
  const bool is_finite = sample.gyro.allFinite() && sample.accel.allFinite();
  ++(is_finite ? statistics_.imu_implausible : statistics_.imu_not_finite);
  return false;
}

// A sensor that is simulated without noise repeats its readings as well, at standstill or at
// constant rates.
bool ImuDoor::IsStuck(const ImuSample& sample) {
  if (!first_alike_ || !AreAlike(*first_alike_, sample)) {
    first_alike_ = sample;
    ++changes_;
  }
  const int64_t begin_ns = first_alike_->t_ns;
  const bool has_noise = changes_ > kManyChanges;
  if (!has_noise || MayStand(sample) || !IsGap(begin_ns, sample.t_ns)) return false;
  if (statistics_.imu_stuck++ == 0) {
    statistics_.first_imu_stuck =
        Format("the same reading from %.3f s on: check the connection of the IMU, and its driver",
               ToSeconds(begin_ns));
  }
  return true;
}

// Compares raw samples: those that came out may differ.
bool ImuDoor::IsRepeated(const ImuSample& sample) const {
  return std::any_of(recent_.begin(), recent_.end(), [&sample](const ImuSample& known) {
    return known.t_ns == sample.t_ns && AreAlike(known, sample);
  });
}

void ImuDoor::DecideAfterGap(int64_t next_ns, AdmittedImu* admitted) {
  if (!after_gap_) return;
  const ImuSample sample = *std::exchange(after_gap_, std::nullopt);
  if (next_ns <= sample.t_ns) {
    ++statistics_.imu_out_of_order;
    return;
  }
  const int64_t newest_ns = recent_.back().t_ns, step_ns = sample.t_ns - newest_ns;
  if (step_ns > kMaxStep_ns) {
    Clear();
    admitted->clock = ClockChange::kForward;
  } else if (statistics_.imu_gaps++ == 0) {
    statistics_.first_imu_gap =
        Format("%.3f s without samples, from %.3f s on", ToSeconds(step_ns), ToSeconds(newest_ns));
  }
  Take(sample, admitted);
}

void ImuDoor::Take(const ImuSample& sample, AdmittedImu* admitted) {
  recent_.push_back(sample);
  while (sample.t_ns - recent_.front().t_ns > kRecent_ns) recent_.pop_front();
  for (const ImuSample& decided : gate_.Add(sample)) admitted->samples.push_back(decided);
}

ImuStatistics ImuDoor::statistics() const {
  ImuStatistics result = statistics_;
  result.imu_replaced = gate_.replaced();
  result.imu_saturated = gate_.saturated();
  result.clipping = gate_.Clipping();
  return result;
}

void ImuDoor::Clear() {
  gate_.Clear();
  recent_.clear();
  jump_.Accept();
  first_alike_.reset();
  changes_ = 0;
  after_gap_.reset();
}

}  // namespace plm_vins
