// SPDX-License-Identifier: BSD-3-Clause
// Compares a length that the calibration states with the one that motion and IMU alone suggest: the
// baseline of two cameras, or measured depths.
#pragma once

#include <optional>

#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/map/sliding_window.h"
#include "vins_estimator/problem/problem_options.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Removes the prior of standard deviation `prior` from an estimate of the logarithm of a length
// relative to the stated one, given its variance P: the estimate is the mean of the prior's zero
// and of the evidence, weighted by their information. Returns nullopt without evidence.
std::optional<LengthEvidence> WithoutPrior(double estimate, double variance, double prior);

// Both use the window's equations at their last linearization: the error of the configured baseline
// of a stereo pair, and what is wrong with the measured depths.
std::optional<LengthEvidence> BaselineError(const ExtrinsicsLink& pair, const SlidingWindow& window,
                                            NormalEquations* equations);
DepthFaults FaultsOfDepths(const SlidingWindow& window, double focal_length,
                           NormalEquations* equations);

}  // namespace plm_vins
