// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

namespace plm_vins {

// The first timestamp of a stream, confirmed by a second one within ten seconds. If the second one
// is further away, it replaces the first: a single wrong timestamp (zero, or far in the future)
// does not count as the beginning.
class ConfirmedStamp {
 public:
  void Add(int64_t t_ns) {
    if (confirmed_) return;
    confirmed_ = IsNear(t_ns);
    if (!confirmed_) t_ns_ = t_ns;
    seen_ = true;
  }

  // Returns whether the first timestamp is confirmed or near `t_ns`, a timestamp of any stream.
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
