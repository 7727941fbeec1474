// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_stream.h"

#include <algorithm>
#include <iterator>

#include "common/imu/imu_samples.h"

namespace plm_vins {

AdmittedImu ImuStream::Add(const ImuSample& sample) {
  AdmittedImu admitted = door_.Add(sample);
  if (admitted.clock != ClockChange::kNone) ClearSamples();
  for (const ImuSample& next : admitted.samples) Queue(next);
  return admitted;
}

void ImuStream::Queue(const ImuSample& sample) {
  samples_.push_back(sample);
  if (static_cast<int>(samples_.size()) > max_samples_) {
    // Keeps the boundary of the last cut, so that the next interval keeps its length.
    samples_.erase(samples_.begin() + (last_cut_ns_ ? 1 : 0));
    ++dropped_full_;
  }
}

void ImuStream::Clear() {
  door_.Clear();
  ClearSamples();
}

void ImuStream::ClearSamples() {
  samples_.clear();
  last_cut_ns_.reset();
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
