// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/flight.h"

#include "simulator/random.h"
#include "simulator/rendering/depth_noise.h"

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
  trajectory.R_V_B = ForwardLookingBody(options.sensors.cameras[0].T_B_C);
  trajectory.seed = options.seed;
  return trajectory;
}

ImuSimulationOptions ImuOptions(const FlightOptions& options) {
  Random random(options.seed, 1);
  ImuSimulationOptions imu;
  imu.noise = options.sensors.imu_noise;
  imu.sensor = options.sensors.imu;
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

// Seeds of a flight's sensors, far from each other.
uint64_t SeedOf(uint64_t seed, int sensor) { return seed + (static_cast<uint64_t>(sensor) << 40); }
constexpr int kDepthSensor = kMaxCameras;

}  // namespace

Flight::Flight(const FlightOptions& options)
    : options_(options),
      world_(MakeWorld(options.world, options.texture, options.seed)),
      trajectory_(TrajectoryThrough(world_, options)),
      imu_(SimulateImu(trajectory_, ImuOptions(options))) {
  for (const CameraSensor& camera : options.sensors.cameras) {
    ImagingOptions imaging = Imaging(options);
    imaging.seed = SeedOf(options.seed, static_cast<int>(cameras_.size()));
    cameras_.emplace_back(trajectory_, world_.scene, camera.parameters, camera.T_B_C, imaging);
  }
}

void Flight::Record(const std::vector<Recorder*>& recorders,
                    const std::function<void(int64_t t_ns)>& progress) const {
  int64_t image_index = 1;  // the first image has preceding IMU samples
  for (const ImuSample& sample : imu_.samples) {
    for (Recorder* recorder : recorders) recorder->Write(sample);
    while (options_.start_ns + ExposureTime(image_index) <= sample.t_ns) {
      progress(RecordImages(recorders, image_index));
      ++image_index;
    }
  }
  for (Recorder* recorder : recorders) recorder->Finish();
}

int64_t Flight::RecordImages(const std::vector<Recorder*>& recorders, int64_t index) const {
  const double t = ToSeconds(ExposureTime(index));
  const int64_t t_ns = options_.start_ns + ExposureTime(index) - ToNanoseconds(options_.sensors.td);
  for (size_t i = 0; i < cameras_.size(); ++i) {
    const ImageSample image{t_ns, cameras_[i].Expose(t, index)};
    for (Recorder* recorder : recorders) recorder->WriteImage(static_cast<int>(i), image);
  }
  if (const auto& sensor = options_.sensors.depth) {
    const cv::Mat1w depth =
        MeasureDepth(cameras_[0].Depth(t), *sensor, SeedOf(options_.seed, kDepthSensor), index);
    for (Recorder* recorder : recorders) recorder->WriteDepth(t_ns, depth);
  }
  return t_ns;
}

int64_t Flight::ExposureTime(int64_t index) const {
  return ToNanoseconds(static_cast<double>(index) / options_.frame_rate_hz);
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
