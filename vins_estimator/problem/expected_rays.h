// SPDX-License-Identifier: BSD-3-Clause
// Predicted observations of landmarks, given the state of the window.
//
// They are the linearization points for the intrinsics. Derivatives at the observed rays would be
// correlated with the noise of the residuals and would bias the focal length to be too short.
#pragma once

#include <Eigen/Core>

#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// Returns the predicted ray; the observed one if the landmark is behind the camera.
Eigen::Vector2d ExpectedRay(const PointLandmark& landmark,
                            const PointLandmark::Observation& observation,
                            const SlidingWindow& window);

// Returns the points of the projected line nearest to the observed end points; these themselves if
// the line has no projection.
SegmentEndPoints ExpectedEnds(const LineLandmark& landmark,
                              const LineLandmark::Observation& observation,
                              const SlidingWindow& window);

}  // namespace plm_vins
