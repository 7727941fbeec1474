// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_bursts.h"

#include <algorithm>
#include <cstdlib>

namespace plm_vins {
namespace {

constexpr size_t kStamps = 201;          // newest timestamps, from which bursts are detected
constexpr size_t kMinBursts = 5;         // minimum number of bursts among them
constexpr double kShort = 0.25;          // longest interval within a burst, relative to the mean
constexpr double kMinShortShare = 0.45;  // minimum share of short intervals; pairs have 1/2
constexpr int64_t kLongestPause_ns = 250'000'000;  // longest pause; a longer one is a gap
constexpr double kCorrection = 0.1;  // share of the phase error that each burst corrects

bool AreCopies(const ImuSample& a, const ImuSample& b) {
  return a.t_ns == b.t_ns && a.gyro == b.gyro && a.accel == b.accel;
}

}  // namespace

ImuSample ImuBursts::Spread(ImuSample sample) {
  if (newest_ && AreCopies(*newest_, sample)) {
    sample.t_ns = spread_ns_.value_or(sample.t_ns);
    return sample;
  }
  newest_ = sample;
  const int64_t pause_ns = stamps_.empty() ? 0 : sample.t_ns - stamps_.back();
  if (pause_ns < 0 || pause_ns > kLongestPause_ns) {
    stamps_.clear();
    spread_ns_.reset();
  }
  const bool begins = pause_ns > kShort * static_cast<double>(interval_ns_);
  // Phase error of the previous burst, from its last timestamp.
  const int64_t late_ns = spread_ns_ && begins ? stamps_.back() - *spread_ns_ : 0;
  stamps_.push_back(sample.t_ns);
  if (stamps_.size() > kStamps) stamps_.pop_front();
  if (begins) Recognize();
  if (size_ == 0) return sample;
  sample.t_ns = SpreadStamp(sample.t_ns, late_ns);
  return sample;
}

void ImuBursts::Recognize() {
  if (stamps_.size() < kStamps) return;
  const auto intervals = static_cast<double>(stamps_.size() - 1);
  const double mean_ns = static_cast<double>(stamps_.back() - stamps_.front()) / intervals;
  size_t bursts = 0, first = 0, last = 0;
  for (size_t i = 1; i < stamps_.size(); ++i) {
    if (static_cast<double>(stamps_[i] - stamps_[i - 1]) <= kShort * mean_ns) continue;
    if (bursts++ == 0) first = i;
    last = i;
  }
  size_ = 0;
  interval_ns_ = 0;
  if (bursts < kMinBursts || static_cast<double>(bursts) > (1 - kMinShortShare) * intervals) return;
  size_ = (last - first) / (bursts - 1);
  interval_ns_ = (stamps_[last] - stamps_[first]) / static_cast<int64_t>(last - first);
}

int64_t ImuBursts::SpreadStamp(int64_t t_ns, int64_t late_ns) {
  const auto size = static_cast<int64_t>(size_);
  const bool is_lost = std::abs(late_ns) > size * interval_ns_;
  if (!spread_ns_ || is_lost) {
    spread_ns_ = t_ns - (size - 1) * interval_ns_;
  } else {
    const auto correction_ns = static_cast<int64_t>(kCorrection * static_cast<double>(late_ns));
    *spread_ns_ += std::max(interval_ns_ + correction_ns, interval_ns_ / 2);
  }
  return *spread_ns_;
}

}  // namespace plm_vins
