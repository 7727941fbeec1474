// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// End points of a line segment in one image, normalized and undistorted. Only their distances to
// the projected line are measurements: their position along the line is arbitrary (aperture
// problem).
struct SegmentEndPoints {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
};

// Computes the distances of both end points to the projection of a line with moment m,
//   d = x~ . m / |(m_x, m_y)|   ([He2018], Eq. (20)),
// and their derivative with respect to the moment (unless null). Returns false if the line has no
// projection because it passes through the camera center or lies in the plane z = 0.
bool EndPointDistances(const SegmentEndPoints& segment, const Eigen::Vector3d& moment_C,
                       Eigen::Vector2d* distances,
                       Eigen::Matrix<double, 2, 3>* d_distances_d_moment);

}  // namespace plm_vins
