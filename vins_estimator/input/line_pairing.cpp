// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/line_pairing.h"

#include <algorithm>
#include <utility>

namespace plm_vins {

void LinePairing::Add(LineFrame frame, bool image_waits) {
  if (newest_ns_ && frame.t_ns <= *newest_ns_) {
    ++statistics_.lines_out_of_order;
    if (frame.t_ns == *newest_ns_) return;
    // The tracker was restarted: its later timestamps belong to the previous sequence.
    while (!frames_.empty() && frames_.back().t_ns >= frame.t_ns) frames_.pop_back();
  }
  newest_ns_ = frame.t_ns;
  if (are_missing() && (image_waits || WasTakenLately(frame.t_ns))) images_without_in_a_row_ = 0;
  if (!taken_ns_.empty() && frame.t_ns <= taken_ns_.back()) {
    ++statistics_.lines_late;
    return;
  }
  frames_.push_back(std::move(frame));
  if (static_cast<int>(frames_.size()) > options_.max_frames) {
    frames_.pop_front();
    ++statistics_.lines_without_points;
  }
}

bool LinePairing::HaveReached(int64_t image_ns) const {
  return !frames_.empty() && frames_.back().t_ns >= image_ns;
}

bool LinePairing::AreDecided(int64_t image_ns, const NewerImages& newer) const {
  if (!options_.expected || are_missing() || HaveReached(image_ns)) return true;
  const bool may_stall = delayed_in_a_row_ < options_.patience;
  return newer.count >= options_.max_lag && !(may_stall && newer.duration <= options_.max_stall);
}

std::optional<LineFrame> LinePairing::Take(int64_t image_ns, const NewerImages& newer) {
  if (!HaveReached(image_ns)) {
    delayed_in_a_row_ = options_.patience;
  } else {
    delayed_in_a_row_ = newer.count < options_.max_lag ? 0 : delayed_in_a_row_ + 1;
  }
  taken_ns_.push_back(image_ns);
  if (static_cast<int>(taken_ns_.size()) > options_.max_lag) taken_ns_.pop_front();
  DropBefore(image_ns);
  if (frames_.empty() || frames_.front().t_ns != image_ns) {
    if (options_.expected) {
      ++statistics_.frames_without_lines;
      ++images_without_in_a_row_;
    }
    return std::nullopt;
  }
  images_without_in_a_row_ = 0;
  unpaired_in_a_row_ = 0;
  LineFrame lines = std::move(frames_.front());
  frames_.pop_front();
  return lines;
}

void LinePairing::DropBefore(int64_t image_ns) {
  while (!frames_.empty() && frames_.front().t_ns < image_ns) {
    frames_.pop_front();
    ++statistics_.lines_without_points;
    ++unpaired_in_a_row_;
  }
}

void LinePairing::Clear() {
  frames_.clear();
  newest_ns_.reset();
  taken_ns_.clear();
}

bool LinePairing::WasTakenLately(int64_t image_ns) const {
  return std::find(taken_ns_.begin(), taken_ns_.end(), image_ns) != taken_ns_.end();
}

}  // namespace plm_vins
