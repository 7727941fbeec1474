// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_estimate.h"

#include "vins_estimator/marginalization/window_marginalizer.h"

namespace plm_vins {

void WindowEstimate::DropSecondNewest() {
  prior = prior.Marginalize(IsOfFrame(map.window.second_newest().state.t_ns));
  map.DropSecondNewest();
}

DepartedLandmarks WindowEstimate::SlideOldest(const ProblemOptions& options, bool stays_as_anchor) {
  prior = MarginalizeOldest(options, prior, &map, stays_as_anchor);
  return map.SlideOldest(stays_as_anchor);
}

void WindowEstimate::RemoveAnchor(int64_t t_ns) {
  prior = prior.Marginalize(IsOfFrame(t_ns));
  map.RemoveAnchor(t_ns);
}

Calibration CalibrationIn(const SlidingWindow& window, const SensorConfig& sensor) {
  Calibration calibration;
  calibration.camera = sensor.cameras[0].parameters.With(window.intrinsics);
  calibration.T_B_C = window.T_B_C();
  calibration.td = window.td;
  if (sensor.cameras.size() > 1) {
    calibration.T_C_C1 = window.T_C_C1();
    calibration.right_camera = sensor.cameras[1].parameters.With(window.right_intrinsics);
  }
  return calibration;
}

WindowEstimate EmptyWindow(const SensorConfig& sensor, const LocalMapOptions& options) {
  WindowEstimate estimate{LocalMap(options)};
  SlidingWindow& window = estimate.map.window;
  window.SetExtrinsic(sensor.cameras[0].T_B_C);
  if (sensor.cameras.size() > 1) {
    window.SetMounting(sensor.cameras[0].T_B_C.Inverse() * sensor.cameras[1].T_B_C);
    window.right_intrinsics = window.right_ray_intrinsics =
        sensor.cameras[1].parameters.intrinsics();
  }
  window.td = sensor.td;
  window.intrinsics = window.ray_intrinsics = sensor.cameras[0].parameters.intrinsics();
  window.gravity_W = Eigen::Vector3d(0, 0, -sensor.gravity_norm);
  return estimate;
}

}  // namespace plm_vins
