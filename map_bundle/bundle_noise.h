// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_bundle/bundle_state.h"

namespace plm_vins {

// What the bundle's residuals show: medians, so that wrong matches do not count. `configured` where
// there are too few.
SightingNoise EstimateNoise(const BundleState& bundle, const SightingNoise& configured);

}  // namespace plm_vins
