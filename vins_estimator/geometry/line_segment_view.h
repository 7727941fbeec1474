// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace plm_vins {

// The end points of a line in one image, normalised and undistorted. Only their distances from the
// projected line count: along the line they may be anywhere (aperture problem).
struct LineSegmentView {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
};

// Distances of both end points from the image of a line with this moment in the camera frame,
//   d = x~ . m / |(m_x, m_y)|   ([He2018], Eq. (20)), and their derivative by the moment.
// False where the line has no image: it passes through the camera or lies in its plane z = 0.
bool EndPointDistances(const LineSegmentView& view, const Eigen::Vector3d& moment_C,
                       Eigen::Vector2d* distances,
                       Eigen::Matrix<double, 2, 3>* d_distances_d_moment);

}  // namespace plm_vins
