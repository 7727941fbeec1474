// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/flight.h"

#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

// Turn-on biases of a small MEMS unit.
constexpr double kGyroBias = 0.01;   // standard deviation [rad/s]
constexpr double kAccelBias = 0.05;  // standard deviation [m/s^2]

TrajectoryOptions TrajectoryThrough(const World& world, const FlightOptions& options) {
  TrajectoryOptions trajectory;
  trajectory.motion = options.motion;
  trajectory.duration = options.duration;
  trajectory.center = world.flight_center;
  trajectory.extent = world.flight_extent;
  trajectory.R_V_B = ForwardLookingBody(options.sensors.T_B_C);
  trajectory.seed = options.seed;
  return trajectory;
}

ImuSimulationOptions ImuOptions(const FlightOptions& options) {
  Random random(options.seed, 1);
  ImuSimulationOptions imu;
  imu.noise = options.sensors.imu_noise;
  imu.gravity_norm = options.sensors.gravity_norm;
  imu.rate_hz = options.sensors.imu_rate;
  imu.start_ns = options.start_ns;
  imu.initial_bias.gyro = kGyroBias * random.NormalVector3();
  imu.initial_bias.accel = kAccelBias * random.NormalVector3();
  imu.seed = options.seed;
  return imu;
}

ImagingOptions Imaging(const FlightOptions& options) {
  ImagingOptions imaging = options.imaging;
  imaging.readout = options.sensors.ReadoutTime();
  imaging.seed = options.seed;
  return imaging;
}

}  // namespace

Flight::Flight(const FlightOptions& options)
    : options_(options),
      world_(MakeWorld(options.world, options.texture, options.seed)),
      trajectory_(TrajectoryThrough(world_, options)),
      imu_(SimulateImu(trajectory_, ImuOptions(options))),
      camera_(trajectory_, world_.scene, options.sensors.camera, options.sensors.T_B_C,
              Imaging(options)) {}

void Flight::Record(const std::vector<Recorder*>& recorders,
                    const std::function<void(int64_t t_ns)>& progress) const {
  const int64_t td_ns = ToNanoseconds(options_.sensors.td);
  int64_t image_index = 1;  // the first image has preceding IMU samples
  const auto exposure_ns = [&] { return ToNanoseconds(image_index / options_.frame_rate_hz); };
  for (const ImuSample& sample : imu_.samples) {
    for (Recorder* recorder : recorders) recorder->Write(sample);
    while (options_.start_ns + exposure_ns() <= sample.t_ns) {
      const double t = ToSeconds(exposure_ns());
      const ImageSample image{options_.start_ns + exposure_ns() - td_ns,
                              camera_.Expose(t, image_index)};
      for (Recorder* recorder : recorders) recorder->Write(image);
      progress(image.t_ns);
      ++image_index;
    }
  }
  for (Recorder* recorder : recorders) recorder->Finish();
}

std::vector<FrameState> Flight::GroundTruth() const {
  std::vector<FrameState> states;
  for (size_t i = 0; i < imu_.samples.size(); ++i) {
    const int64_t t_ns = imu_.samples[i].t_ns;
    const BodyState body = trajectory_.At(ToSeconds(t_ns - options_.start_ns));
    states.push_back(TrueState(t_ns, body, imu_.biases[i]));
  }
  return states;
}

}  // namespace plm_vins::simulator
