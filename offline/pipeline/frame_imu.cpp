// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/frame_imu.h"

#include <algorithm>

#include "common/imu/imu_range.h"

namespace plm_vins {
namespace {

// As of the estimator's input.
constexpr int64_t kMaxInterval_ns = 50'000'000;  // longer ones are gaps
constexpr size_t kMostWaiting = 50000;           // samples, where no frame comes

}  // namespace

FrameImu::FrameImu(const ImuRange& range) : gate_(range) {}

void FrameImu::Add(const ImuSample& sample) {
  if (!IsPlausible(sample) || (last_ns_ && sample.t_ns <= *last_ns_)) return;
  if (after_gap_ && after_gap_->t_ns < sample.t_ns) Keep(*after_gap_);
  after_gap_.reset();
  if (last_ns_ && sample.t_ns - *last_ns_ > kMaxInterval_ns) {
    after_gap_ = sample;
  } else {
    Keep(sample);
  }
}

void FrameImu::Keep(const ImuSample& sample) {
  last_ns_ = sample.t_ns;
  for (const ImuSample& decided : gate_.Add(sample)) samples_.push_back(decided);
  while (samples_.size() > kMostWaiting) samples_.pop_front();
}

std::vector<ImuSample> FrameImu::Take(int64_t t_ns) {
  const auto end = std::upper_bound(samples_.begin(), samples_.end(), t_ns,
                                    [](int64_t t, const ImuSample& s) { return t < s.t_ns; });
  const std::vector<ImuSample> taken(samples_.begin(), end);
  samples_.erase(samples_.begin(), end);
  return taken;
}

void FrameImu::Clear() {
  samples_.clear();
  last_ns_.reset();
  after_gap_.reset();
  gate_.Clear();
}

}  // namespace plm_vins
