// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "simulator/default_sensors.h"
#include "simulator/imu_simulator.h"
#include "simulator/trajectory.h"
#include "test/feature_simulator/feature_world.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

struct FeatureSimulationOptions {
  // Cameras, shutter, td, IMU, gravity; a second camera and depth if there are any. Lines have no
  // observations in the second camera.
  SensorConfig sensors = DefaultSensors();
  // Its R_V_B is replaced, such that the camera looks forward.
  TrajectoryOptions trajectory;
  FeatureRoomOptions room;
  double frame_rate_hz = 20.0;
  bool add_imu_noise = true;
  ImuBias initial_bias;
  int64_t start_ns = 1'000'000'000'000;  // IMU timestamp of the trajectory's start

  double point_noise_px = 0.5;  // for each raw pixel coordinate
  double line_noise_px = 0.5;   // for each raw pixel coordinate of an endpoint
  double line_end_slide = 0.1;  // each endpoint moves inwards by up to this share of the length
  double point_break_probability = 0.0;  // for each image: the track continues with a new id
  double line_break_probability = 0.0;
  double point_outlier_ratio = 0.0;  // share of observations with errors of up to outlier_px
  double outlier_px = 40.0;
  double second_outlier_ratio = 0.0;  // share of such observations in the second camera
  int max_points = 150;               // for each image
  int max_lines = 50;                 // for each image
  double min_line_length_px = 40.0;
  uint64_t seed = 1;  // seed of landmarks and noise; the trajectory has its own
};

// Output of the front ends and the IMU on a simulated flight, with ground truth.
struct FeatureDataset {
  std::vector<ImuSample> imu;
  std::vector<PointFrame> points;  // one for each image
  std::vector<LineFrame> lines;    // one for each image, with equal timestamps
  std::vector<FrameState> truth;   // one for each image, with equal timestamps, at exposure time
  FeatureWorld world;              // true landmarks
  std::map<int64_t, int> point_landmark;  // id -> index in world.points
  std::map<int64_t, int> line_landmark;   // id -> index in world.lines
};

// Image timestamps satisfy t_imu = t + td: the image with timestamp t shows the scene at t + td in
// IMU time (with a rolling shutter, in its middle row). Equal options give bit-identical results.
FeatureDataset SimulateFeatures(const FeatureSimulationOptions& options);

}  // namespace plm_vins::simulator
