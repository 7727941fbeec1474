// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/flight.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plm_vins::simulator {
namespace {

// Stores a recording in memory.
class MemoryRecorder : public Recorder {
 public:
  void Write(const ImuSample& sample) override {
    imu.push_back(sample);
    order.push_back(sample.t_ns);
  }
  void Write(const ImageSample& image) override {
    images.push_back(image);
    order.push_back(image.t_ns);
  }
  void Finish() override { finished = true; }

  std::vector<ImuSample> imu;
  std::vector<ImageSample> images;
  std::vector<int64_t> order;
  bool finished = false;
};

FlightOptions SmallFlight() {
  FlightOptions options;
  options.texture = TextureStyle::kWeak;
  options.duration = 2.0;
  options.frame_rate_hz = 10.0;
  CameraParameters& camera = options.sensors.camera;
  camera.width = 188;
  camera.height = 120;
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value *= 0.25;
  return options;
}

MemoryRecorder Record(const FlightOptions& options) {
  MemoryRecorder recorder;
  Flight(options).Record({&recorder}, [](int64_t) {});
  return recorder;
}

const MemoryRecorder& Reference() {
  static const MemoryRecorder recording = Record(SmallFlight());
  return recording;
}

TEST(Flight, RecordsAllSensorsInOrderOfTime) {
  const MemoryRecorder& recording = Reference();
  EXPECT_EQ(recording.imu.size(), 401u);
  EXPECT_EQ(recording.images.size(), 20u);
  EXPECT_TRUE(std::is_sorted(recording.order.begin(), recording.order.end()));
  EXPECT_EQ(recording.images[0].gray.size(), cv::Size(188, 120));
  EXPECT_EQ(recording.images[1].t_ns - recording.images[0].t_ns, 100'000'000);
  EXPECT_TRUE(recording.finished);
}

TEST(Flight, TheRateOfTheImuIsThatOfTheSensors) {
  FlightOptions options = SmallFlight();
  options.sensors.imu_rate = 100;
  const MemoryRecorder recording = Record(options);
  EXPECT_EQ(recording.imu.size(), 201u);
  EXPECT_EQ(recording.imu[1].t_ns - recording.imu[0].t_ns, 10'000'000);
}

TEST(Flight, TimeOffsetMovesTheImageStampsOnly) {
  FlightOptions options = SmallFlight();
  const MemoryRecorder& plain = Reference();
  options.sensors.td = 0.02;
  const MemoryRecorder shifted = Record(options);
  EXPECT_EQ(shifted.images[3].t_ns + 20'000'000, plain.images[3].t_ns);
  EXPECT_EQ(cv::countNonZero(shifted.images[3].gray != plain.images[3].gray), 0);
  EXPECT_EQ(shifted.imu[3].t_ns, plain.imu[3].t_ns);
}

TEST(Flight, TheShutterIsThatOfTheSensors) {
  FlightOptions options = SmallFlight();
  options.sensors.rolling_shutter_tr = 0.03;
  const MemoryRecorder global = Record(options);
  EXPECT_EQ(cv::countNonZero(global.images.back().gray != Reference().images.back().gray), 0);
  options.sensors.rolling_shutter = true;
  const MemoryRecorder rolling = Record(options);
  EXPECT_EQ(rolling.images.back().t_ns, global.images.back().t_ns);
  EXPECT_GT(cv::countNonZero(rolling.images.back().gray != global.images.back().gray), 1000);
}

TEST(Flight, SameSeedSameBytes) {
  FlightOptions options = SmallFlight();
  const MemoryRecorder& a = Reference();
  const MemoryRecorder b = Record(options);
  options.seed = 2;
  const MemoryRecorder c = Record(options);
  for (size_t i = 0; i < a.images.size(); ++i) {
    EXPECT_EQ(cv::countNonZero(a.images[i].gray != b.images[i].gray), 0);
  }
  EXPECT_EQ(a.imu[300].gyro, b.imu[300].gyro);
  EXPECT_NE(a.imu[300].gyro, c.imu[300].gyro);
  EXPECT_GT(cv::countNonZero(a.images[9].gray != c.images[9].gray), 1000);
}

TEST(Flight, GroundTruthBelongsToTheImuSamples) {
  const Flight flight(SmallFlight());
  const std::vector<FrameState> truth = flight.GroundTruth();
  ASSERT_EQ(truth.size(), flight.imu().samples.size());
  // During the standstill of the first second, the accelerometer measures gravity and its bias.
  const FrameState& state = truth[100];
  EXPECT_EQ(state.t_ns, flight.imu().samples[100].t_ns);
  const Eigen::Vector3d expected =
      state.rotation().conjugate() * Eigen::Vector3d(0, 0, 9.81) + state.accel_bias();
  EXPECT_LT((flight.imu().samples[100].accel - expected).norm(), 0.15);
  EXPECT_LT(state.velocity().norm(), 1e-12);
}

}  // namespace
}  // namespace plm_vins::simulator
