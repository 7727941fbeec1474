// SPDX-License-Identifier: BSD-3-Clause
// Where a view should see its landmark, by the state of the window.
//
// Derivatives by the intrinsics are taken there. Taken at the rays that were observed, each would
// share the noise of its residual, and all together would say that the focal length is too short.
#pragma once

#include <Eigen/Core>

#include "vins_estimator/map/line_landmark.h"
#include "vins_estimator/map/point_landmark.h"
#include "vins_estimator/map/sliding_window.h"

namespace plm_vins {

// As it was observed where the landmark is not in front of the camera.
Eigen::Vector2d ExpectedRay(const PointLandmark& landmark, const PointView& view,
                            const SlidingWindow& window);

// The points of the line's image nearest to the ends that were observed; those themselves where it
// has no image.
LineSegmentView ExpectedEnds(const LineLandmark& landmark, const LineView& view,
                             const SlidingWindow& window);

}  // namespace plm_vins
