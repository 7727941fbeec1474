// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/expected_rays.h"

#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {

Eigen::Vector2d ExpectedRay(const PointLandmark& landmark, const PointView& view,
                            const SlidingWindow& window) {
  const Eigen::Vector3d p_C = window.T_W_C(view.t_ns).Inverse() * PositionInWorld(landmark, window);
  return p_C.z() > kMinProjectedDepth ? Eigen::Vector2d(p_C.hnormalized()) : view.bearing.xy;
}

LineSegmentView ExpectedEnds(const LineLandmark& landmark, const LineView& view,
                             const SlidingWindow& window) {
  const Eigen::Vector3d moment =
      (window.T_W_C(view.t_ns).Inverse() * LineInWorld(landmark, window)).moment;
  Eigen::Vector2d distances;
  if (!EndPointDistances(view.segment, moment, &distances, nullptr)) return view.segment;
  const Eigen::Vector2d normal = moment.head<2>().normalized();
  return {view.segment.start - distances[0] * normal, view.segment.end - distances[1] * normal};
}

}  // namespace plm_vins
