// SPDX-License-Identifier: BSD-3-Clause
// How near to a camera a landmark may be [m]. Each step accepts what the one before has made, with
// room to move.
#pragma once

namespace plm_vins {

constexpr double kMinTriangulatedDepth = 0.1;  // of a new landmark: nearer, it is a wrong match
constexpr double kMinLandmarkDepth = 0.05;     // of one that has moved: nearer, it is removed
constexpr double kMinProjectedDepth = 0.01;    // in a projection: nearer, the step is refused

}  // namespace plm_vins
