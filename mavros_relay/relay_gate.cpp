// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/relay_gate.h"

#include <cstdlib>
#include <stdexcept>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kMaxGap = 0.2;  // between states [s]; any restart of the estimator takes longer
constexpr double kMaxAge = 0.5;  // of the last image's estimate [s]
// Minimum pause of the states at an interruption [s]: EKF2 notices pauses of 0.4 s and more.
constexpr double kMinPause = 1.0;

}  // namespace

RelayGate::RelayGate(double rate) : rate_(rate) {
  if (!(rate >= 0.1 && rate <= 1000)) {  // NaN as well
    throw std::invalid_argument("rate must be 0.1 to 1000 Hz");
  }
}

bool RelayGate::Pass(int64_t t_ns) {
  const bool continues =
      state_ns_ && t_ns > *state_ns_ && t_ns - *state_ns_ <= ToNanoseconds(kMaxGap);
  state_ns_ = t_ns;
  if (!continues || !IsUsable(t_ns)) is_interrupted_ = true;
  if (!IsUsable(t_ns)) return false;
  if (is_interrupted_) {
    const bool is_too_soon =
        passed_ns_ && t_ns >= *passed_ns_ && t_ns - *passed_ns_ < ToNanoseconds(kMinPause);
    if (is_too_soon) return false;
    if (passed_ns_) ++resets_;
    is_interrupted_ = false;
    due_ns_ = t_ns;
  }
  if (!IsDue(t_ns)) return false;
  passed_ns_ = t_ns;
  return true;
}

bool RelayGate::IsUsable(int64_t t_ns) const {
  return image_ns_ && std::abs(t_ns - *image_ns_) <= ToNanoseconds(kMaxAge);
}

bool RelayGate::IsDue(int64_t t_ns) {
  if (t_ns < due_ns_) return false;
  const int64_t period_ns = ToNanoseconds(1 / rate_);
  due_ns_ += period_ns * (1 + (t_ns - due_ns_) / period_ns);
  return true;
}

}  // namespace plm_vins
