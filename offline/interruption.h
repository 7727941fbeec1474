// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// From here on the first SIGINT or SIGTERM asks the run to come to an end, and the second ends the
// program at once. One that whoever started the program ignores stays ignored, as with nohup.
void WatchForInterruption();

// The signal that has come; zero: none has.
int Interruption();

}  // namespace plm_vins
