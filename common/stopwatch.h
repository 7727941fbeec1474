// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace plm_vins {

// Milliseconds since construction, for timing reports only: results must not depend on it.
class Stopwatch {
 public:
  double Milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace plm_vins
