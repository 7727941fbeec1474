// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "offline/recordings/recording.h"

namespace plm_vins {

// Opens a folder in the ASL format of EuRoC: DIR/mav0 (or DIR itself) contains cam0/data.csv,
// cam0/data/*.png and imu0/data.csv, and likewise cam1/, ... for further
// cameras and depth0/ if they are asked for. Throws std::runtime_error with the missing part.
std::unique_ptr<Recording> OpenAslFolder(const std::string& folder, int cameras = 1,
                                         bool with_depth = false);

}  // namespace plm_vins
