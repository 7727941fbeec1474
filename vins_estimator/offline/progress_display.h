// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace plm_vins {

// Progress of an offline run on stderr: a bar that is redrawn where that is a terminal, else a line
// now and then.
class ProgressDisplay {
 public:
  // `end_ns`: stamp at which the run will end, where that is known.
  explicit ProgressDisplay(std::optional<int64_t> end_ns);

  // A frame of this stamp is done.
  void Update(int64_t t_ns);

  // Clears the bar.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  void DrawBar(double seconds, double share, double speed) const;
  void PrintLine(double seconds, double share, double speed) const;

  std::optional<int64_t> end_ns_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  std::optional<int64_t> first_ns_;
};

}  // namespace plm_vins
