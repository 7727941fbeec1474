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
  SensorConfig sensors = DefaultSensors();  // cameras, depth, shutter, td, IMU, gravity
  ImagingOptions imaging;                   // its readout and seed are overwritten by those here
  double frame_rate_hz = 20.0;
  int64_t start_ns = 1'600'000'000'000'000'000;  // IMU timestamp of the start
  uint64_t seed = 1;
};

// A flight through a rendered world. The timestamp of an image is the middle of its exposure (with
// a rolling shutter, that of the middle row) minus td, for all cameras and for depth;
// IMU and ground truth are in IMU time.
class Flight {
 public:
  explicit Flight(const FlightOptions& options);
  Flight(const Flight&) = delete;  // its members refer to each other
  Flight& operator=(const Flight&) = delete;

  // Passes all samples to the recorders in temporal order and finishes them; calls `progress` with
  // the timestamp of each image.
  void Record(const std::vector<Recorder*>& recorders,
              const std::function<void(int64_t t_ns)>& progress) const;

  // True states at the timestamps of the IMU samples.
  std::vector<FrameState> GroundTruth() const;

  const ImuSimulation& imu() const { return imu_; }

 private:
  // Records all images of one exposure and returns their timestamp.
  int64_t RecordImages(const std::vector<Recorder*>& recorders, int64_t index) const;
  int64_t ExposureTime(int64_t index) const;  // after the start [ns]

  FlightOptions options_;
  World world_;
  Trajectory trajectory_;
  ImuSimulation imu_;
  std::vector<CameraSimulator> cameras_;
};

}  // namespace plm_vins::simulator
