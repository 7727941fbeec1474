// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace plm_vins {

// Distinguishes a restart of a stream's timestamps (a replayed bag, a clock set back) from single
// timestamps out of order. A restart is recognized after more than `patience` consecutive
// increasing rejected timestamps. After a smaller step back, the rejected timestamps catch up with
// the last accepted one, and the next timestamp follows them at their own rate; late single
// messages do not show this pattern.
class BackwardJumpDetector {
 public:
  explicit BackwardJumpDetector(int patience) : patience_(patience) {}

  // Reports a timestamp that follows the last accepted one.
  void Accept() { rejected_in_a_row_ = 0; }

  // Reports a timestamp that does not follow. Returns true if the stream restarts with it.
  bool Reject(int64_t t_ns) {
    const bool in_a_row = rejected_in_a_row_ > 0 && t_ns > rejected_ns_;
    rejected_in_a_row_ = in_a_row ? rejected_in_a_row_ + 1 : 1;
    if (!in_a_row) first_rejected_ns_ = t_ns;
    rejected_ns_ = t_ns;
    return rejected_in_a_row_ > patience_;
  }

  // Returns whether the last timestamp was rejected.
  bool HasRejected() const { return rejected_in_a_row_ > 0; }

  // To be called for a timestamp that follows the last accepted one, before Accept(). Returns true
  // if the stream was restarted at the rejected timestamps.
  bool EndsStepBack(int64_t t_ns) const {
    return rejected_in_a_row_ >= kShortestStep &&
           t_ns - rejected_ns_ <= (rejected_ns_ - first_rejected_ns_) / 2;
  }

 private:
  static constexpr int kShortestStep = 10;  // timestamps; fewer may be late single messages

  int patience_;
  int rejected_in_a_row_ = 0;
  int64_t first_rejected_ns_ = 0;  // first of the consecutive rejected timestamps
  int64_t rejected_ns_ = 0;        // last rejected timestamp
};

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
