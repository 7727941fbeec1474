// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_bundle/bundle_state.h"

namespace plm_vins {

// Estimates the observation noise from the residuals of the bundle. Medians make it robust against
// wrong matches. Returns `configured` if there are too few residuals.
ObservationNoise EstimateNoise(const BundleState& bundle, const ObservationNoise& configured);

}  // namespace plm_vins
