// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// Formats one row of a TUM trajectory, "timestamp tx ty tz qx qy qz qw", with nine decimals each.
// The timestamp is in seconds, exact to the nanosecond.
std::string FormatTumRow(int64_t t_ns, const Rigid3d& T_W_B);

// Formats a comment between rows: the following poses are in a new world frame.
std::string FormatTumRestart(const std::string& reason);

}  // namespace plm_vins
