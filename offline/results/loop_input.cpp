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
  result.T_B_C.clear();
  for (const CameraCalibration& camera : output.calibration.cameras) {
    result.T_B_C.push_back(camera.T_B_C);
    result.refined.push_back(camera.parameters);
  }
  // An unknown covariance is zero, so that odometry edges get the minimum of OdometryNoise.
  if (output.uncertainty) result.covariance = output.uncertainty->pose;
  result.R_O_Manhattan = output.R_W_M;
  result.corners = PlaceCorners(frame.points, output.points);
  result.segments = PlaceSegments(frame.lines, output.lines);
  for (size_t camera = 0; camera < frame.images.size(); ++camera) {
    const ImageSample& image = frame.images[camera];
    if (!image.gray.empty()) result.images[static_cast<int>(camera)] = {image.gray, image.owner};
  }
  return result;
}

}  // namespace plm_vins
