// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

// "timestamp tx ty tz qx qy qz qw", the stamp in seconds.
void WriteTum(const std::string& path, const std::vector<FrameState>& states);

// As in EuRoC's state_groundtruth_estimate0/data.csv: pose, velocity and both biases.
void WriteEurocCsv(const std::string& path, const std::vector<FrameState>& states);

}  // namespace plm_vins::simulator
