// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace plm_vins {

// Samples further apart than this leave a gap: the motion between them is unknown, not just noisy.
constexpr double kMaxImuInterval = 0.05;  // [s]

}  // namespace plm_vins
