// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/expected_rays.h"

#include "vins_estimator/geometry/depth_limits.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {

Eigen::Vector2d ExpectedRay(const PointLandmark& landmark,
                            const PointLandmark::Observation& observation,
                            const SlidingWindow& window) {
  const Eigen::Vector3d p_C =
      window.T_W_C(observation).Inverse() * PositionInWorld(landmark, window);
  return p_C.z() > kMinProjectedDepth ? Eigen::Vector2d(p_C.hnormalized()) : observation.bearing.xy;
}

SegmentEndPoints ExpectedEnds(const LineLandmark& landmark,
                              const LineLandmark::Observation& observation,
                              const SlidingWindow& window) {
  const SegmentEndPoints& observed = observation.segment;
  const Eigen::Vector3d moment =
      (window.T_W_C(observation).Inverse() * LineInWorld(landmark, window)).moment;
  Eigen::Vector2d distances;
  if (!EndPointDistances(observed, moment, &distances, nullptr)) return observed;
  const Eigen::Vector2d normal = moment.head<2>().normalized();
  return {observed.start - distances[0] * normal, observed.end - distances[1] * normal};
}

}  // namespace plm_vins
