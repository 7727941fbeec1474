// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

namespace plm_vins {

// The first stamp of a stream, which the second confirms by lying within ten seconds. Where it does
// not, that one takes its place: a single wrong stamp (zero, or far in the future) is no beginning.
class ConfirmedStamp {
 public:
  void Add(int64_t t_ns) {
    if (confirmed_) return;
    confirmed_ = IsNear(t_ns);
    if (!confirmed_) t_ns_ = t_ns;
    seen_ = true;
  }

  // False where there is no stamp yet, or where this one, of another stream, is a reason to doubt
  // it.
  bool Admits(int64_t t_ns) const { return confirmed_ || IsNear(t_ns); }

  std::optional<int64_t> t_ns() const { return seen_ ? std::make_optional(t_ns_) : std::nullopt; }

 private:
  static constexpr int64_t kNear_ns = 10'000'000'000;

  bool IsNear(int64_t t_ns) const { return seen_ && std::abs(t_ns - t_ns_) <= kNear_ns; }

  int64_t t_ns_ = 0;
  bool seen_ = false;
  bool confirmed_ = false;
};

}  // namespace plm_vins
