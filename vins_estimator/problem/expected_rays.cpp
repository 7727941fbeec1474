// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/expected_rays.h"

#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {
namespace {

Eigen::Vector2d RayOr(const Eigen::Vector2d& observed, const Rigid3d& T_W_C,
                      const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d p_C = T_W_C.Inverse() * p_W;
  return p_C.z() > kMinProjectedDepth ? Eigen::Vector2d(p_C.hnormalized()) : observed;
}

LineSegmentView EndsNearest(const LineSegmentView& observed, const Rigid3d& T_W_C,
                            const PluckerLine& line_W) {
  const Eigen::Vector3d moment = (T_W_C.Inverse() * line_W).moment;
  Eigen::Vector2d distances;
  if (!EndPointDistances(observed, moment, &distances, nullptr)) return observed;
  const Eigen::Vector2d normal = moment.head<2>().normalized();
  return {observed.start - distances[0] * normal, observed.end - distances[1] * normal};
}

}  // namespace

Eigen::Vector2d ExpectedRay(const PointLandmark& landmark, const PointView& view,
                            const SlidingWindow& window) {
  return RayOr(view.bearing.xy, window.T_W_C(view.t_ns), PositionInWorld(landmark, window));
}

Eigen::Vector2d ExpectedRightRay(const PointLandmark& landmark, const PointView& view,
                                 const SlidingWindow& window) {
  return RayOr(*view.right, window.T_W_C1(view.t_ns), PositionInWorld(landmark, window));
}

LineSegmentView ExpectedEnds(const LineLandmark& landmark, const LineView& view,
                             const SlidingWindow& window) {
  return EndsNearest(view.segment, window.T_W_C(view.t_ns), LineInWorld(landmark, window));
}

LineSegmentView ExpectedRightEnds(const LineLandmark& landmark, const LineView& view,
                                  const SlidingWindow& window) {
  return EndsNearest({view.right->start, view.right->end}, window.T_W_C1(view.t_ns),
                     LineInWorld(landmark, window));
}

}  // namespace plm_vins
