// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/geometry/rigid3.h"

namespace plm_vins {

// One line of a TUM trajectory: "timestamp tx ty tz qx qy qz qw" with nine decimals each; the stamp
// in seconds, exact to the nanosecond.
std::string FormatTumRow(int64_t t_ns, const Rigid3d& T_W_B);

// A comment between rows: the world frame of the next one is another than that of those before.
std::string FormatTumRestart(const std::string& reason);

}  // namespace plm_vins
