// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace plm_vins {

// Displays the progress through a recording on stderr: a progress bar on a terminal, otherwise
// occasional lines.
class ProgressDisplay {
 public:
  // `end_ns` is the timestamp at which the recording ends, if known; `duration` [s] is the length
  // of the run, which may be infinite.
  explicit ProgressDisplay(std::optional<int64_t> end_ns,
                           double duration = std::numeric_limits<double>::infinity());

  // Reports that the frame with this timestamp is done.
  void Update(int64_t t_ns);

  // Clears the bar.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  void DrawBar(double seconds, double share, double speed) const;
  void PrintLine(double seconds, double share, double speed) const;

  double Share(double seconds) const;

  std::optional<int64_t> end_ns_;
  double duration_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  std::optional<int64_t> first_ns_;
};

}  // namespace plm_vins
