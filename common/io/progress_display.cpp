// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/progress_display.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "common/measurements.h"

namespace plm_vins {
namespace {

constexpr double kBarPeriod = 0.1;   // [s]
constexpr double kLinePeriod = 5.0;  // [s]
constexpr int kBarWidth = 40;

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

ProgressDisplay::ProgressDisplay(std::optional<int64_t> end_ns, double duration)
    : end_ns_(end_ns), duration_(duration), terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressDisplay::Update(int64_t t_ns) {
  if (!first_ns_) first_ns_ = t_ns;
  const Clock::time_point now = Clock::now();
  if (Seconds(now - last_shown_) < (terminal_ ? kBarPeriod : kLinePeriod)) return;
  last_shown_ = now;
  const double seconds = ToSeconds(t_ns - *first_ns_);
  const double speed = seconds / Seconds(now - start_);
  const double share = Share(seconds);
  terminal_ ? DrawBar(seconds, share, speed) : PrintLine(seconds, share, speed);
}

// Progress of the run, 0 to 1; zero if its length is unknown.
double ProgressDisplay::Share(double seconds) const {
  const double left = end_ns_ ? ToSeconds(*end_ns_ - *first_ns_) : duration_;
  const double length = std::min(left, duration_);
  return length > 0 ? std::clamp(seconds / length, 0.0, 1.0) : 0.0;
}

void ProgressDisplay::DrawBar(double seconds, double share, double speed) const {
  const int filled = static_cast<int>(share * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r[%s] %3.0f %%  %.1f s  %.1f x real time ", bar.c_str(), 100 * share,
               seconds, speed);
}

void ProgressDisplay::PrintLine(double seconds, double share, double speed) const {
  std::fprintf(stderr, "%.1f s done (%.0f %%), %.1f x real time\n", seconds, 100 * share, speed);
}

void ProgressDisplay::Finish() {
  if (terminal_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace plm_vins
