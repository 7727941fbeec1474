// SPDX-License-Identifier: BSD-3-Clause
// Least depths of landmarks in a camera [m]. Each step's limit is below that of the previous step,
// so that a landmark may move a little.
#pragma once

namespace plm_vins {

constexpr double kMinTriangulatedDepth = 0.1;  // triangulation: a nearer landmark is a wrong match
constexpr double kMinLandmarkDepth = 0.05;     // outlier rejection: a nearer landmark is removed
constexpr double kMinProjectedDepth = 0.01;    // projection: nearer, a solver step is rejected

}  // namespace plm_vins
