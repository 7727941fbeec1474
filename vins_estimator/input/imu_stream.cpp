// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_stream.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/format.h"
#include "common/imu/imu_interpolation.h"
#include "common/streams/stamp_order.h"

namespace plm_vins {
ImuStream::ImuStream(const ImuSensor& sensor, double max_gap, int max_samples)
    : max_gap_(max_gap), max_samples_(max_samples), gate_(sensor), jump_(kImuJumps.patience) {}

ImuStream::Clock ImuStream::Add(const ImuSample& sample) {
  if (!IsReading(sample)) return Clock::kRunsOn;
  const bool follows = !last_ns_ || sample.t_ns > *last_ns_;
  if (!follows) {
    ++statistics_.imu_out_of_order;
    // A duplicate is no evidence of a clock change, unless samples before it were rejected: then a
    // recording is played again.
    if (!jump_.HasRejected() && memory_.Contains(sample)) return Clock::kRunsOn;
  }
  const bool set_back = follows ? jump_.EndsStepBack(sample.t_ns) : jump_.Reject(sample.t_ns);
  if (!follows && !set_back) return Clock::kRunsOn;
  if (set_back) Clear();
  jump_.Accept();
  const bool set_on = JudgeSampleAfterGap(sample.t_ns);
  if (LeavesGap(sample.t_ns)) {
    after_gap_ = sample;
  } else {
    Take(sample);
  }
  if (set_back) return Clock::kSetBack;
  return set_on ? Clock::kSetOn : Clock::kRunsOn;
}

bool ImuStream::IsReading(const ImuSample& sample) {
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) {
    ++statistics_.imu_not_finite;
    return false;
  }
  if (!IsPlausible(sample)) {
    ++statistics_.imu_implausible;
    return false;
  }
  return true;
}

bool ImuStream::IsGap(int64_t begin_ns, int64_t end_ns) const {
  return ToSeconds(end_ns - begin_ns) > max_gap_;
}

bool ImuStream::JudgeSampleAfterGap(int64_t next_ns) {
  if (!after_gap_) return false;
  const ImuSample sample = *std::exchange(after_gap_, std::nullopt);
  if (next_ns <= sample.t_ns) {
    ++statistics_.imu_out_of_order;
    return false;
  }
  const bool set_on = sample.t_ns - *last_ns_ > kImuJumps.max_step_ns;
  if (set_on) {
    Clear();
  } else if (statistics_.imu_gaps++ == 0) {
    statistics_.first_imu_gap = Format("%.3f s without samples, from %.3f s on",
                                       ToSeconds(sample.t_ns - *last_ns_), ToSeconds(*last_ns_));
  }
  Take(sample);
  return set_on;
}

void ImuStream::Take(const ImuSample& sample) {
  last_ns_ = sample.t_ns;
  memory_.Add(sample);
  for (const ImuSample& decided : gate_.Add(sample)) Queue(decided);
  statistics_.imu_replaced = gate_.replaced();
  statistics_.imu_saturated = gate_.saturated();
}

void ImuStream::Queue(const ImuSample& sample) {
  samples_.push_back(sample);
  if (static_cast<int>(samples_.size()) > max_samples_) {
    // Keeps the boundary of the last cut, so that the next interval keeps its length.
    samples_.erase(samples_.begin() + (last_cut_ns_ ? 1 : 0));
    ++statistics_.imu_dropped_full;
  }
}

void ImuStream::Clear() {
  samples_.clear();
  last_cut_ns_.reset();
  gate_.Clear();
  memory_.Clear();
  last_ns_.reset();
  after_gap_.reset();
  jump_.Accept();  // accept any next sample
}

bool ImuStream::IsInGap(int64_t t_ns) const {
  const size_t next = FirstNotBefore(t_ns);
  return samples_[next].t_ns > t_ns && IsGap(samples_[next - 1].t_ns, samples_[next].t_ns);
}

std::vector<ImuSample> ImuStream::Cut(int64_t t_ns) {
  const size_t next = FirstNotBefore(t_ns);
  const ImuSample boundary =
      next == 0 ? samples_.front() : InterpolateImu(samples_[next - 1], samples_[next], t_ns);
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(next);
  std::vector<ImuSample> cut(samples_.begin(), end);
  cut.push_back(boundary);

  // The boundary replaces the samples that were output: it starts the next interval.
  const bool on_sample = samples_[next].t_ns == t_ns;
  samples_.erase(samples_.begin(), on_sample ? std::next(end) : end);
  samples_.push_front(boundary);
  last_cut_ns_ = t_ns;
  return cut;
}

size_t ImuStream::FirstNotBefore(int64_t t_ns) const {
  const auto first =
      std::lower_bound(samples_.begin(), samples_.end(), t_ns,
                       [](const ImuSample& sample, int64_t t) { return sample.t_ns < t; });
  return static_cast<size_t>(std::distance(samples_.begin(), first));
}

}  // namespace plm_vins
