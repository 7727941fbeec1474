// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

// Writes rows "timestamp tx ty tz qx qy qz qw" with the timestamp in seconds.
void WriteTum(const std::string& path, const std::vector<FrameState>& states);

// Writes the format of EuRoC's state_groundtruth_estimate0/data.csv: pose, velocity and biases.
void WriteEurocCsv(const std::string& path, const std::vector<FrameState>& states);

}  // namespace plm_vins::simulator
