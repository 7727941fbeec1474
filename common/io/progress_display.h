// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace plm_vins {

// Progress through a recording on stderr: a bar that is redrawn where that is a terminal, else a
// line now and then.
class ProgressDisplay {
 public:
  // `end_ns`: stamp at which the recording ends, where that is known; `duration`: after which the
  // run does [s], may be infinite.
  explicit ProgressDisplay(std::optional<int64_t> end_ns,
                           double duration = std::numeric_limits<double>::infinity());

  // A frame of this stamp is done.
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
