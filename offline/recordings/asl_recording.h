// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "offline/recordings/recording.h"

namespace plm_vins {

// Opens a folder of the ASL format, as EuRoC has it: DIR/mav0 (or DIR itself) holds cam0/data.csv,
// cam0/data/*.png and imu0/data.csv. Throws std::runtime_error that says which part is missing.
std::unique_ptr<Recording> OpenAslFolder(const std::string& folder);

}  // namespace plm_vins
