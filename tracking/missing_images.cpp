// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/missing_images.h"

#include <cmath>

#include "common/format.h"
#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr int kInARow = 20;              // that make a cause certain
constexpr double kJitter = 2e-4;         // of a constant offset [s]
constexpr double kMostTolerance = 0.02;  // that the configuration allows [s]

}  // namespace

void MissingImages::AddUnusable(int64_t t_ns, const std::string& why) {
  unusable_ = Unusable{t_ns, why};
}

void MissingImages::AddPaired(int64_t t_ns) {
  const bool is_same = missing_since_pair_ > 0 && missing_since_pair_ == last_gap_;
  same_gaps_ = is_same ? same_gaps_ + 1 : 0;
  if (same_gaps_ == kInARow) JudgeRate(ToSeconds(t_ns - *paired_ns_));
  last_gap_ = missing_since_pair_;
  missing_since_pair_ = same_offsets_ = 0;
  paired_ns_ = t_ns;
}

void MissingImages::AddMissing(int64_t t_ns, const std::optional<int64_t>& last_ns) {
  if (unusable_ && unusable_->t_ns >= last_ns.value_or(0)) {
    count_.Add(unusable_->why);
  } else if (!last_ns) {
    count_.Add("none has come yet");
  } else {
    ++missing_since_pair_;
    AddLate(ToSeconds(*last_ns - t_ns));
  }
}

void MissingImages::AddLate(double later) {
  const double apart_ms = 1e3 * std::abs(later);
  const char* direction = later < 0 ? "earlier" : "later";
  count_.Add(Format("the last one's timestamp is %.1f ms %s", apart_ms, direction));
  same_offsets_ = std::abs(later - last_offset_) < kJitter ? same_offsets_ + 1 : 0;
  last_offset_ = later;
  if (same_offsets_ != kInARow) return;
  const double tolerance = 1e-3 * std::ceil(1e3 * std::abs(later) + 0.5);
  count_.detail =
      Format("its timestamps are a constant %.1f ms %s than those of camera 0; ", apart_ms,
             direction) +
      (tolerance <= kMostTolerance
           ? Format("if one clock stamps both, set stamp_tolerance: %.3f", tolerance)
           : std::string("are the cameras triggered in turn? They must be triggered together"));
}

// `interval` is that of the last two pairs [s].
void MissingImages::JudgeRate(double interval) {
  count_.detail = Format("%.1f come per second, and %.1f of camera 0; set one rate for both",
                         1 / interval, (last_gap_ + 1) / interval);
}

}  // namespace plm_vins
