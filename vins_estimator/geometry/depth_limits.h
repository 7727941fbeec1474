// SPDX-License-Identifier: BSD-3-Clause
// Least depths of landmarks in a camera [m]. They are far below the depth of anything in focus: a
// limit close to true depths, as above the ground before a take-off, would accept only those that
// noise has made too large, and bias the scale. Each step's limit is below that of the previous
// step, so that a landmark may move a little.
#pragma once

namespace plm_vins {

constexpr double kMinTriangulatedDepth = 0.02;  // triangulation: a nearer landmark is a wrong match
constexpr double kMinLandmarkDepth = 0.01;      // outlier rejection: a nearer landmark is removed
constexpr double kMinProjectedDepth = 0.002;    // projection: nearer, a solver step is rejected

}  // namespace plm_vins
