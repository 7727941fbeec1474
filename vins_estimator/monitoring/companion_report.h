// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Describes what is wrong with the second camera and with measured depths; empty if nothing is.
std::string DescribeFaults(const SecondCameraFaults& second_camera, const DepthFaults& depth);

}  // namespace plm_vins
