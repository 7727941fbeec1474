// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/measurements.h"

namespace plm_vins {

// Returns the derivative of the inverse depth by the normalized image point at each point of an
// image, from the plane through the measured depths nearby (in inverse depth, a plane is linear);
// zero where there are too few, or where they are not on a plane.
std::vector<Eigen::Vector2d> DepthSlopes(const PointFrame& frame);

}  // namespace plm_vins
