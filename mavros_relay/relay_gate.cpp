// SPDX-License-Identifier: BSD-3-Clause
#include "mavros_relay/relay_gate.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kMaxGap = 0.2;  // between states [s]; any restart of the estimator takes longer

// Throws for NaN as well.
void RequireWithin(double value, double min, double max, const std::string& text) {
  if (!(value >= min && value <= max)) throw std::invalid_argument(text);
}

}  // namespace

RelayGate::RelayGate(const Options& options) : options_(options) {
  RequireWithin(options.rate, 0.1, 1000, "rate must be 0.1 to 1000 Hz");
  RequireWithin(options.max_age, 0.001, 1000, "max_age must be 0.001 to 1000 s");
  RequireWithin(options.min_pause, 0.001, 1000, "min_pause must be 0.001 to 1000 s");
}

bool RelayGate::Pass(int64_t t_ns) {
  const bool continues =
      state_ns_ && t_ns > *state_ns_ && t_ns - *state_ns_ <= ToNanoseconds(kMaxGap);
  state_ns_ = t_ns;
  if (!continues || !IsUsable(t_ns)) is_interrupted_ = true;
  if (!IsUsable(t_ns)) return false;
  if (is_interrupted_) {
    const bool is_too_soon =
        passed_ns_ && t_ns >= *passed_ns_ && t_ns - *passed_ns_ < ToNanoseconds(options_.min_pause);
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
  return image_ns_ && std::abs(t_ns - *image_ns_) <= ToNanoseconds(options_.max_age);
}

bool RelayGate::IsDue(int64_t t_ns) {
  if (t_ns < due_ns_) return false;
  const int64_t period_ns = ToNanoseconds(1 / options_.rate);
  due_ns_ += period_ns * (1 + (t_ns - due_ns_) / period_ns);
  return true;
}

}  // namespace plm_vins
