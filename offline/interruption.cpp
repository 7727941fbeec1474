// SPDX-License-Identifier: BSD-3-Clause
#include "offline/interruption.h"

#include <atomic>
#include <csignal>

namespace plm_vins {
namespace {

// The only state that a signal handler may set; threads read it as well.
std::atomic<int> interruption{0};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int kSignals[] = {SIGINT, SIGTERM};

void OnSignal(int signal) {
  interruption = signal;
  for (const int other : kSignals) std::signal(other, SIG_DFL);
}

}  // namespace

void WatchForInterruption() {
  for (const int signal : kSignals) {
    if (std::signal(signal, OnSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

int Interruption() { return interruption; }

}  // namespace plm_vins
