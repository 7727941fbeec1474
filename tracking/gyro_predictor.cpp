// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/gyro_predictor.h"

#include <algorithm>
#include <iterator>

#include "common/geometry/so3.h"
#include "common/imu/imu_samples.h"

namespace plm_vins {
namespace {

constexpr int64_t kHistory_ns = 5'000'000'000;  // exceeds the time that any image waits
constexpr int64_t kMaxGap_ns = 100'000'000;     // the rotation in a longer one is unknown
constexpr int kPatience = 100;                  // of the door [samples]

}  // namespace

GyroPredictor::GyroPredictor(const Rigid3d& T_B_C, double td, const ImuSensor& imu)
    : R_B_C_(T_B_C.rotation), td_ns_(ToNanoseconds(td)), door_(imu, kPatience) {}

void GyroPredictor::AddImu(const ImuSample& sample) {
  const AdmittedImu admitted = door_.Add(sample);
  if (admitted.clock != ClockChange::kNone) samples_.clear();
  samples_.insert(samples_.end(), admitted.samples.begin(), admitted.samples.end());
  while (!samples_.empty() && samples_.front().t_ns < samples_.back().t_ns - kHistory_ns) {
    samples_.pop_front();
  }
}

bool GyroPredictor::Covers(int64_t t_image_ns) const {
  return !samples_.empty() && samples_.back().t_ns >= t_image_ns + td_ns_;
}

std::optional<Eigen::Quaterniond> GyroPredictor::Rotation(int64_t t0_ns, int64_t t1_ns) const {
  const int64_t begin = t0_ns + td_ns_;
  const int64_t end = t1_ns + td_ns_;
  if (end < begin || !Covers(t1_ns) || samples_.front().t_ns > begin) return std::nullopt;

  Eigen::Quaterniond R_B0_B1 = Eigen::Quaterniond::Identity();
  auto right = std::upper_bound(samples_.begin(), samples_.end(), begin,
                                [](int64_t t, const ImuSample& s) { return t < s.t_ns; });
  for (; right != samples_.end() && std::prev(right)->t_ns < end; ++right) {
    const ImuSample& a = *std::prev(right);
    const ImuSample& b = *right;
    if (b.t_ns - a.t_ns > kMaxGap_ns) return std::nullopt;
    const int64_t from = std::max(a.t_ns, begin);
    const int64_t to = std::min(b.t_ns, end);
    const Eigen::Vector3d rate = InterpolateImu(a, b, from + (to - from) / 2).gyro;
    R_B0_B1 = R_B0_B1 * SO3Exp(rate * ToSeconds(to - from));
  }
  return (R_B_C_.conjugate() * R_B0_B1.conjugate() * R_B_C_).normalized();
}

}  // namespace plm_vins
