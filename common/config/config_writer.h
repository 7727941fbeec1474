// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "common/config/config.h"

namespace plm_vins {

// Writes a configuration as a file that LoadConfig() reads from any folder: every key with the
// value in effect, in the format of OpenCV. A comment at its head lists the overrides among them.
void WriteConfig(const Config& config, std::ostream* stream);

}  // namespace plm_vins
