// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vins_estimator/least_squares/normal_equations.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Returns the relative error of the configured baseline length of the second camera, from motion
// and IMU alone, without the prior on the length, given the window's equations at their last
// linearization. The estimate x, with variance P, is a mean of that error and of the prior's zero,
// weighted by their information. Returns nullopt if the error is not significant.
std::optional<double> BaselineError(const SlidingWindow& window, double configured_length,
                                    NormalEquations* equations);

}  // namespace plm_vins
