// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/imu_history.h"

#include <algorithm>
#include <iterator>

#include "common/imu/imu_samples.h"

namespace plm_vins {
namespace {

// Returns the first sample at or after the time.
std::deque<ImuSample>::const_iterator AtOrAfter(const std::deque<ImuSample>& samples,
                                                int64_t t_ns) {
  return std::lower_bound(
      samples.begin(), samples.end(), t_ns,
      [](const ImuSample& sample, int64_t time_ns) { return sample.t_ns < time_ns; });
}

}  // namespace

void ImuHistory::Add(const ImuSample& sample) {
  if (recordings_.empty() || sample.t_ns < recordings_.back().back().t_ns) {
    recordings_.emplace_back().push_back(sample);
  } else if (sample.t_ns > recordings_.back().back().t_ns) {
    recordings_.back().push_back(sample);
  }
}

// Interpolation at either time needs a sample on both sides of it.
void ImuHistory::Forget(int recording, int64_t from_ns, int64_t to_ns) {
  std::deque<ImuSample>& samples = recordings_.at(recording);
  const auto first_kept = AtOrAfter(samples, from_ns), next_kept = AtOrAfter(samples, to_ns);
  if (next_kept - first_kept > 2) samples.erase(first_kept + 1, next_kept - 1);
}

std::optional<Preintegration> ImuHistory::Between(int recording, int64_t from_ns, int64_t to_ns,
                                                  const ImuNoise& noise,
                                                  const ImuBias& bias) const {
  if (recording < 0 || recording > newest() || from_ns >= to_ns) return std::nullopt;
  const std::deque<ImuSample>& samples = recordings_[recording];
  if (from_ns < samples.front().t_ns || to_ns > samples.back().t_ns) return std::nullopt;
  const auto interpolated = [&](int64_t t_ns) {
    const auto after = AtOrAfter(samples, t_ns);
    return after->t_ns == t_ns ? *after : InterpolateImu(*std::prev(after), *after, t_ns);
  };
  Preintegration result(noise, bias);
  result.Append(interpolated(from_ns));
  for (auto sample = AtOrAfter(samples, from_ns + 1); sample->t_ns < to_ns; ++sample) {
    result.Append(*sample);
  }
  result.Append(interpolated(to_ns));
  return result;
}

}  // namespace plm_vins
