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
  calibration.cameras.clear();
  for (size_t i = 0; i < window.cameras.size(); ++i) {
    calibration.cameras.push_back({sensor.cameras[i].parameters.With(window.cameras[i].intrinsics),
                                   window.cameras[i].T_B_C()});
  }
  calibration.td = window.td;
  return calibration;
}

WindowEstimate EmptyWindow(const SensorConfig& sensor, const LocalMapOptions& options) {
  WindowEstimate estimate{LocalMap(options)};
  SlidingWindow& window = estimate.map.window;
  window.cameras.resize(sensor.cameras.size());
  for (size_t i = 0; i < window.cameras.size(); ++i) {
    WindowCamera& camera = window.cameras[i];
    camera.SetExtrinsics(sensor.cameras[i].T_B_C);
    camera.intrinsics = camera.ray_intrinsics = sensor.cameras[i].parameters.intrinsics();
  }
  window.td = sensor.td;
  window.gravity_W = Eigen::Vector3d(0, 0, -sensor.gravity_norm);
  return estimate;
}

}  // namespace plm_vins
