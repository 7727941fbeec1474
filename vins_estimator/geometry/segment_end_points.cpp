// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/segment_end_points.h"

namespace plm_vins {
namespace {

constexpr double kMinMoment = 1e-9;

}  // namespace

bool EndPointDistances(const SegmentEndPoints& segment, const Eigen::Vector3d& moment_C,
                       Eigen::Vector2d* distances,
                       Eigen::Matrix<double, 2, 3>* d_distances_d_moment) {
  const double norm = moment_C.head<2>().norm();
  if (!(norm > kMinMoment)) return false;
  Eigen::Matrix<double, 2, 3> ends;
  ends << segment.start.transpose(), 1, segment.end.transpose(), 1;
  *distances = ends * moment_C / norm;
  if (d_distances_d_moment == nullptr) return true;
  *d_distances_d_moment = ends / norm;
  d_distances_d_moment->leftCols<2>() -=
      *distances * moment_C.head<2>().transpose() / (norm * norm);
  return true;
}

}  // namespace plm_vins
