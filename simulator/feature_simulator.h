// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/config/config.h"
#include "common/measurements.h"
#include "simulator/default_sensors.h"
#include "simulator/feature_world.h"
#include "simulator/imu_simulator.h"
#include "simulator/trajectory.h"
#include "vins_estimator/state/frame_state.h"

namespace plm_vins::simulator {

struct FeatureSimulationOptions {
  SensorConfig sensors = DefaultSensors();  // camera, shutter, T_B_C, td, IMU, gravity
  // Its R_V_B is replaced: the camera looks forward.
  TrajectoryOptions trajectory;
  FeatureRoomOptions room;
  double frame_rate_hz = 20.0;
  bool add_imu_noise = true;
  ImuBias initial_bias;
  int64_t start_ns = 1'000'000'000'000;  // IMU stamp of the trajectory's start

  double point_noise_px = 0.5;           // per raw pixel coordinate
  double line_noise_px = 0.5;            // per raw pixel coordinate of an end point
  double line_end_slide = 0.1;           // each end moves inwards by up to this share of the line
  double point_break_probability = 0.0;  // per image: the track goes on under a new id
  double line_break_probability = 0.0;
  double point_outlier_ratio = 0.0;  // observations that are anywhere within outlier_px
  double outlier_px = 40.0;
  int max_points = 150;  // per image
  int max_lines = 50;    // per image
  double min_line_length_px = 40.0;
  uint64_t seed = 1;  // of the landmarks and all noise; the trajectory has its own
};

// What the front ends and the IMU deliver on a simulated flight, and the truth behind it.
struct FeatureDataset {
  std::vector<ImuSample> imu;
  std::vector<PointFrame> points;         // one per image
  std::vector<LineFrame> lines;           // one per image, same stamps
  std::vector<FrameState> truth;          // one per image, same stamps, at exposure time
  FeatureWorld world;                     // true landmarks
  std::map<int64_t, int> point_landmark;  // id -> index into world.points
  std::map<int64_t, int> line_landmark;   // id -> index into world.lines
};

// Image stamps t obey t_imu = t + td: the image stamped t shows the scene at t + td of the IMU
// clock, with a rolling shutter in its middle row. The same options give the same bytes.
FeatureDataset SimulateFeatures(const FeatureSimulationOptions& options);

}  // namespace plm_vins::simulator
