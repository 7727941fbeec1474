// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Installs signal handlers: the first SIGINT or SIGTERM requests the end of the run, the second
// terminates the program at once. A signal that is ignored at program start, as with nohup, stays
// ignored.
void WatchForInterruption();

// The received signal; zero if none.
int Interruption();

}  // namespace plm_vins
