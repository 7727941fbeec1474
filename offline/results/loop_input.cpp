// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/loop_input.h"

#include "vins_estimator/output/placed_features.h"

namespace plm_vins {

OdometryFrame ToOdometryFrame(const PipelineFrame& frame, bool restarted) {
  const EstimatorOutput& output = frame.output;
  OdometryFrame result;
  result.t_ns = output.t_ns;
  result.restarted = restarted;
  result.T_O_B = output.state.T_W_B();
  result.T_B_C = output.calibration.cameras[0].T_B_C;
  result.camera = output.calibration.cameras[0].parameters;
  // An unknown covariance is zero, so that odometry edges get the minimum of OdometryNoise.
  if (output.uncertainty) result.covariance = output.uncertainty->pose;
  result.R_O_Manhattan = output.R_W_M;
  result.corners = PlaceCorners(frame.points, output.points);
  result.segments = PlaceSegments(frame.lines, output.lines);
  result.gray = frame.image.gray;
  return result;
}

}  // namespace plm_vins
