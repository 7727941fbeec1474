// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "common/config/config.h"

namespace plm_vins {

// Writes a configuration file that LoadConfig() can read from any folder: every key with its
// effective value, in OpenCV's format. A comment at the head of the file lists the overrides.
void WriteConfig(const Config& config, std::ostream* stream);

}  // namespace plm_vins
