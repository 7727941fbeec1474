// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "common/config/config.h"

namespace plm_vins {

// Writes a configuration as a file that LoadConfig() reads from any folder: every key with the
// value in effect, in the format of OpenCV.
void WriteConfig(const Config& config, std::ostream* stream);

}  // namespace plm_vins
