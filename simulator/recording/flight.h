// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/config/config.h"
#include "simulator/default_sensors.h"
#include "simulator/imu_simulator.h"
#include "simulator/recording/recorder.h"
#include "simulator/rendering/camera_simulator.h"
#include "simulator/rendering/world.h"
#include "simulator/trajectory.h"

namespace plm_vins::simulator {

struct FlightOptions {
  WorldKind world = WorldKind::kRoom;
  TextureStyle texture = TextureStyle::kRich;
  Motion motion = Motion::kGentle;
  double duration = 60.0;                   // [s]
  SensorConfig sensors = DefaultSensors();  // camera, shutter, T_B_C, td, IMU, gravity
  ImagingOptions imaging;                   // but its read-out and seed, which are those here
  double frame_rate_hz = 20.0;
  int64_t start_ns = 1'600'000'000'000'000'000;  // IMU stamp of the start
  uint64_t seed = 1;
};

// A flight through a rendered world. Images are stamped in the middle of their exposure (with a
// rolling shutter that of the middle row), less td;
// the IMU and the ground truth are on the IMU's clock.
class Flight {
 public:
  explicit Flight(const FlightOptions& options);
  Flight(const Flight&) = delete;  // its parts refer to each other
  Flight& operator=(const Flight&) = delete;

  // Hands all samples to the recorders in order of time and finishes them; `progress` gets each
  // image's stamp.
  void Record(const std::vector<Recorder*>& recorders,
              const std::function<void(int64_t t_ns)>& progress) const;

  // True states at the IMU samples.
  std::vector<FrameState> GroundTruth() const;

  const ImuSimulation& imu() const { return imu_; }

 private:
  FlightOptions options_;
  World world_;
  Trajectory trajectory_;
  ImuSimulation imu_;
  CameraSimulator camera_;
};

}  // namespace plm_vins::simulator
