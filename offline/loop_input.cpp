// SPDX-License-Identifier: BSD-3-Clause
#include "offline/loop_input.h"

#include <unordered_map>
#include <vector>

namespace plm_vins {
namespace {

std::vector<TrackedCorner> ToCorners(const PipelineFrame& frame) {
  std::unordered_map<int64_t, Eigen::Vector3d> places;
  for (const MapPoint& point : frame.output.points) places.emplace(point.id, point.p_W);
  std::vector<TrackedCorner> corners;
  for (const PointObservation& observation : frame.points.points) {
    TrackedCorner& corner = corners.emplace_back();
    corner.observation = observation;
    const auto place = places.find(observation.id);
    if (place != places.end()) corner.p_O = place->second;
  }
  return corners;
}

std::vector<TrackedSegment> ToSegments(const PipelineFrame& frame) {
  std::unordered_map<int64_t, SpaceSegment> places;
  for (const MapLine& line : frame.output.lines) {
    places.emplace(line.id, SpaceSegment{line.start_W, line.end_W});
  }
  std::vector<TrackedSegment> segments;
  for (const LineObservation& observation : frame.lines.lines) {
    TrackedSegment& segment = segments.emplace_back();
    segment.observation = observation;
    const auto place = places.find(observation.id);
    if (place != places.end()) segment.landmark = place->second;
  }
  return segments;
}

}  // namespace

OdometryFrame ToOdometryFrame(const PipelineFrame& frame, bool restarted) {
  const EstimatorOutput& output = frame.output;
  OdometryFrame result;
  result.t_ns = output.t_ns;
  result.restarted = restarted;
  result.T_O_B = output.state.T_W_B();
  result.T_B_C = output.T_B_C;
  result.covariance = output.pose_covariance;
  result.R_O_M = output.R_W_M;
  result.corners = ToCorners(frame);
  result.segments = ToSegments(frame);
  result.gray = frame.image.gray;
  return result;
}

}  // namespace plm_vins
