// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Describes what is wrong with cameras other than the first and with measured depths; empty if
// nothing is.
std::string DescribeFaults(const std::vector<CameraFaults>& cameras, const DepthFaults& depth);

}  // namespace plm_vins
