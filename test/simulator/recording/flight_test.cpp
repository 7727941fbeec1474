// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/recording/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "common/geometry/so3.h"

namespace plm_vins::simulator {
namespace {

// Stores a recording in memory.
class MemoryRecorder : public Recorder {
 public:
  void Write(const ImuSample& sample) override {
    imu.push_back(sample);
    order.push_back(sample.t_ns);
  }
  void WriteImage(int camera, const ImageSample& image) override {
    if (camera > 0) return second.push_back(image);
    images.push_back(image);
    order.push_back(image.t_ns);
  }
  void WriteDepth(int64_t t_ns, const cv::Mat1w& depth) override {
    depths.push_back(depth);
    EXPECT_EQ(t_ns, images.back().t_ns);
  }
  void Finish() override { finished = true; }

  std::vector<ImuSample> imu;
  std::vector<ImageSample> images, second;
  std::vector<cv::Mat1w> depths;
  std::vector<int64_t> order;
  bool finished = false;
};

FlightOptions SmallFlight() {
  FlightOptions options;
  options.texture = TextureStyle::kWeak;
  options.duration = 2.0;
  options.frame_rate_hz = 10.0;
  CameraParameters& camera = options.sensors.cameras[0].parameters;
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

TEST(Flight, ImuRateIsConfigured) {
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

TEST(Flight, ShutterIsConfigured) {
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

// Returns the mean difference in brightness of a point in both images, the depth of which is known.
double MeanDifference(const MemoryRecorder& recording, const SensorConfig& sensors,
                      const Rigid3d& T_C1_C0) {
  const auto left = CameraModel::Create(sensors.cameras[0].parameters);
  const auto right = CameraModel::Create(sensors.cameras[1].parameters);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < recording.images.size(); ++i) {
    cv::Mat1b blurred_left, blurred_right;
    cv::GaussianBlur(recording.images[i].gray, blurred_left, {5, 5}, 1);
    cv::GaussianBlur(recording.second[i].gray, blurred_right, {5, 5}, 1);
    for (int y = 20; y < 100; y += 4) {
      for (int x = 20; x < 168; x += 4) {
        const double z = 1e-3 * recording.depths[i](y, x);
        const auto xy = left->Unproject({x, y});
        const auto pixel = right->Project(T_C1_C0 * (z * xy->homogeneous()));
        if (z == 0 || !pixel || !right->IsInImage(*pixel, 1)) continue;
        const cv::Point nearest(cvRound(pixel->x()), cvRound(pixel->y()));
        sum += std::abs(double{1} * blurred_left(y, x) - blurred_right(nearest));
        ++count;
      }
    }
  }
  EXPECT_GT(count, 5000);
  return sum / count;
}

TEST(Flight, SecondCameraAndDepthAgreeOnWherePointsAre) {
  FlightOptions options = SmallFlight();
  options.texture = TextureStyle::kRich;
  options.imaging.vignetting = 0;
  CameraSensor& second = options.sensors.cameras.emplace_back();
  second.parameters = options.sensors.cameras[0].parameters;
  second.parameters.fx *= 1.03;
  second.parameters.cx += 4;
  const Rigid3d T_C0_C1(SO3Exp({0.01, 0.02, -0.03}), {0.11, 0.01, -0.02});
  second.T_B_C = options.sensors.cameras[0].T_B_C * T_C0_C1;
  options.sensors.depth = DepthSensor{"/depth", 0, 0.001, 20};
  const MemoryRecorder recording = Record(options);
  ASSERT_EQ(recording.second.size(), recording.images.size());
  ASSERT_EQ(recording.depths.size(), recording.images.size());
  const double right = MeanDifference(recording, options.sensors, T_C0_C1.Inverse());
  const double wrong = MeanDifference(recording, options.sensors,
                                      {T_C0_C1.rotation.conjugate(), Eigen::Vector3d::Zero()});
  EXPECT_LT(right, 0.5 * wrong) << wrong;
}

TEST(Flight, FurtherSensorsDoNotChangeTheImages) {
  FlightOptions options = SmallFlight();
  EXPECT_TRUE(Reference().second.empty());
  EXPECT_TRUE(Reference().depths.empty());
  options.sensors.cameras.push_back(options.sensors.cameras[0]);
  options.sensors.depth = DepthSensor{"/depth"};
  const MemoryRecorder recording = Record(options);
  for (size_t i = 0; i < recording.images.size(); ++i) {
    EXPECT_EQ(cv::countNonZero(recording.images[i].gray != Reference().images[i].gray), 0);
    // In the same place, only the noise differs.
    EXPECT_GT(cv::countNonZero(recording.second[i].gray != Reference().images[i].gray), 1000);
    EXPECT_LT(cv::norm(recording.second[i].gray, Reference().images[i].gray, cv::NORM_L1),
              4.0 * 188 * 120);
  }
}

}  // namespace
}  // namespace plm_vins::simulator
