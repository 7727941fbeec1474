// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "common/streams/backward_jump.h"

namespace plm_vins {

// When jumps of the timestamps of a stream are believed.
struct JumpPolicy {
  int patience;  // more rejected timestamps in a row restart the stream (BackwardJumpDetector)
  int64_t max_step_ns;  // a longer step ahead must be confirmed by the next timestamp
};

// The estimator is more patient than the trackers, so that these decide first.
constexpr JumpPolicy kImageJumps = {10, 1'000'000'000};
constexpr JumpPolicy kFeatureJumps = {10, 10'000'000'000};  // for trackers that do not check theirs

enum class StampVerdict { kFollows, kFollowsGap, kRestarts, kIsBack, kIsAhead };

// Decides which timestamps of a stream to accept. Rejects timestamps that do not increase, unless
// the stream restarts with them. Rejects a single timestamp far in the future, after which all
// others would seem late: the first timestamp after a long step is rejected, and the next one
// confirms the step.
class StampOrder {
 public:
  explicit StampOrder(const JumpPolicy& policy) : policy_(policy), back_(policy.patience) {}

  StampVerdict Add(int64_t t_ns) {
    const StampVerdict verdict = Judge(t_ns);
    if (IsAccepted(verdict)) {
      back_.Accept();
      newest_ns_ = t_ns;
    }
    return verdict;
  }

  static bool IsAccepted(StampVerdict verdict) { return verdict <= StampVerdict::kRestarts; }

  // Newest accepted timestamp; nullopt before the first.
  std::optional<int64_t> newest_ns() const { return newest_ns_; }

  // Accepts any next timestamp.
  void Clear() { *this = StampOrder(policy_); }

 private:
  StampVerdict Judge(int64_t t_ns) {
    if (!newest_ns_) return StampVerdict::kFollows;
    if (t_ns <= *newest_ns_) {
      return back_.Reject(t_ns) ? StampVerdict::kRestarts : StampVerdict::kIsBack;
    }
    const bool leaps = t_ns - *newest_ns_ > policy_.max_step_ns;
    const bool confirmed = ahead_ns_ && t_ns > *ahead_ns_;
    ahead_ns_.reset();
    if (!leaps) return StampVerdict::kFollows;
    if (confirmed) return StampVerdict::kFollowsGap;
    ahead_ns_ = t_ns;
    return StampVerdict::kIsAhead;
  }

  JumpPolicy policy_;
  BackwardJumpDetector back_;
  std::optional<int64_t> newest_ns_;
  std::optional<int64_t> ahead_ns_;  // the previous timestamp, if it was ahead
};

}  // namespace plm_vins
