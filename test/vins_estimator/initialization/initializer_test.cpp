// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/initializer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using testing::FlightOptions;
using testing::SimulatedFlight;
using testing::SimulateFlight;

Config ConfigFor(const SimulatedFlight& flight) {
  Config config;
  config.sensor = flight.sensor;
  return config;
}

struct Start {
  InitializationResult result;
  size_t index;  // of the image at which it succeeded
};

std::optional<Start> Feed(const SimulatedFlight& flight, Initializer* initializer) {
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    auto result = initializer->Add(flight.frames[i]);
    if (result) return Start{*result, i};
  }
  return std::nullopt;
}

const FrameState& TruthAt(const SimulatedFlight& flight, int64_t t_ns) {
  return *std::find_if(flight.truth.begin(), flight.truth.end(),
                       [t_ns](const FrameState& state) { return state.t_ns == t_ns; });
}

double ScaleError(const Start& start, const SimulatedFlight& flight) {
  std::vector<Eigen::Vector3d> estimate, truth;
  for (const InitialFrame& frame : start.result.frames) {
    estimate.push_back(frame.state.position());
    truth.push_back(TruthAt(flight, frame.state.t_ns).position());
  }
  return testing::SizeOf(estimate) / testing::SizeOf(truth) - 1;
}

// Many starts in mid-flight: the typical error is small, and none is large.
TEST(InitializerTest, StartsInFlight) {
  for (const auto motion : {simulator::Motion::kGentle, simulator::Motion::kFast}) {
    double squared_scale_error = 0;
    constexpr int kSeeds = 10;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      auto options = FlightOptions(motion, seed);
      options.point_outlier_ratio = 0.02;
      const SimulatedFlight flight = SimulateFlight(options, /*skip=*/4);
      Initializer initializer(ConfigFor(flight));
      const auto start = Feed(flight, &initializer);
      ASSERT_TRUE(start) << "seed " << seed << ": " << initializer.reason();
      EXPECT_LE(start->index, 60u) << "seed " << seed;
      EXPECT_FALSE(start->result.from_standstill);
      EXPECT_TRUE(initializer.reason().empty());
      const double scale_error = ScaleError(*start, flight);
      squared_scale_error += scale_error * scale_error / kSeeds;
      const FrameState& newest = start->result.frames.back().state;
      const FrameState& truth = flight.truth[start->index];
      EXPECT_EQ(newest.t_ns, truth.t_ns);
      EXPECT_LT(std::abs(scale_error), 0.2) << "seed " << seed;  // two standard deviations
      EXPECT_LT(testing::GravityError(newest, truth), 0.025) << "seed " << seed;
      EXPECT_LT(testing::VelocityError(newest, truth), 0.2) << "seed " << seed;
      EXPECT_LT((newest.gyro_bias() - truth.gyro_bias()).norm(), 0.02) << "seed " << seed;
    }
    EXPECT_LT(std::sqrt(squared_scale_error), 0.05);
  }
}

// With the configured noise, the scale would stay too uncertain for a start.
TEST(InitializerTest, StartsInFlightIfTheConfigurationOverstatesTheAccelerometerNoise) {
  constexpr double kOverstatement = 30;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const auto options = FlightOptions(simulator::Motion::kFast, seed);
    const SimulatedFlight flight = SimulateFlight(options, /*skip=*/4);
    Config config = ConfigFor(flight);
    config.sensor.imu_noise.accel_density *= kOverstatement;
    Initializer initializer(config);
    const auto start = Feed(flight, &initializer);
    ASSERT_TRUE(start) << "seed " << seed << ": " << initializer.reason();
    EXPECT_LE(start->index, 60u) << "seed " << seed;
    EXPECT_LT(std::abs(ScaleError(*start, flight)), 0.15) << "seed " << seed;
  }
}

// Fast motion makes the scale observable within a second.
TEST(InitializerTest, StartsWithinASecondOfFastFlight) {
  constexpr int kSeeds = 10;
  double images = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = FlightOptions(simulator::Motion::kFast, seed);
    const SimulatedFlight flight = SimulateFlight(options, /*skip=*/4);
    Initializer initializer(ConfigFor(flight));
    const auto start = Feed(flight, &initializer);
    ASSERT_TRUE(start) << "seed " << seed << ": " << initializer.reason();
    images += static_cast<double>(start->index) / kSeeds;
  }
  EXPECT_LT(images / 20, 1.0);
}

TEST(InitializerTest, FramesAreLinkedByTheirImuSamples) {
  const SimulatedFlight flight = SimulateFlight(FlightOptions(simulator::Motion::kFast, 1), 4);
  Initializer initializer(ConfigFor(flight));
  const auto start = Feed(flight, &initializer);
  ASSERT_TRUE(start);
  const auto& frames = start->result.frames;
  EXPECT_EQ(frames.size(), 11u);
  for (size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].measurement.t_ns, frames[i].state.t_ns);
    EXPECT_EQ(frames[i].measurement.imu.back().t_ns, frames[i].state.t_ns);
    if (i == 0) continue;
    EXPECT_EQ(frames[i].measurement.imu.front().t_ns, frames[i - 1].state.t_ns);
  }
}

TEST(InitializerTest, SmallWindowGetsFewFrames) {
  const SimulatedFlight flight = SimulateFlight(FlightOptions(simulator::Motion::kFast, 1), 4);
  Config config = ConfigFor(flight);
  config.estimator.window_size = 6;
  Initializer initializer(config);
  const auto start = Feed(flight, &initializer);
  ASSERT_TRUE(start) << initializer.reason();
  EXPECT_EQ(start->result.frames.size(), 7u);
  EXPECT_EQ(start->result.frames.back().state.t_ns, flight.truth[start->index].t_ns);
}

TEST(InitializerTest, StandstillIsEnough) {
  auto options = FlightOptions(simulator::Motion::kStill, 1);
  const SimulatedFlight flight = SimulateFlight(options);
  Initializer initializer(ConfigFor(flight));
  const auto start = Feed(flight, &initializer);
  ASSERT_TRUE(start) << initializer.reason();
  EXPECT_TRUE(start->result.from_standstill);
  EXPECT_LE(start->index, 20u);
  const FrameState& state = start->result.frames.back().state;
  EXPECT_EQ(state.t_ns, flight.truth[start->index].t_ns);
  EXPECT_EQ(state.velocity(), Eigen::Vector3d::Zero());
  EXPECT_LT((state.gyro_bias() - options.initial_bias.gyro).norm(), 1e-3);
  // An accelerometer bias of 0.09 m/s^2 causes a tilt of half a degree.
  EXPECT_LT(testing::GravityError(state, flight.truth[start->index]), 0.012);
}

TEST(InitializerTest, HalfASecondIsNoStandstillIfCornersMoveTogether) {
  for (const double drift_px : {0.0, 0.05}) {  // per image
    SimulatedFlight flight = SimulateFlight(FlightOptions(simulator::Motion::kStill, 1));
    for (size_t i = 0; i < flight.frames.size(); ++i) {
      for (PointObservation& point : flight.frames[i].points.points) {
        point.uv_px.x() += drift_px * static_cast<double>(i);
      }
    }
    Initializer initializer(ConfigFor(flight));
    const auto start = Feed(flight, &initializer);
    ASSERT_TRUE(start) << initializer.reason();
    EXPECT_EQ(start->index < 14, drift_px == 0) << start->index;
  }
}

// A tenth of a second on the ground is too short for a start from standstill, and must not disturb
// the start in motion.
TEST(InitializerTest, StartsFromMotionAfterAStillPart) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    auto options = FlightOptions(simulator::Motion::kFast, seed);
    options.trajectory.rest = 1.0;
    const SimulatedFlight flight = SimulateFlight(options, /*skip=*/0.9);
    Initializer initializer(ConfigFor(flight));
    const auto start = Feed(flight, &initializer);
    ASSERT_TRUE(start) << "seed " << seed << ": " << initializer.reason();
    if (start->result.from_standstill) continue;  // a slow take-off
    EXPECT_LT(std::abs(ScaleError(*start, flight)), 0.15) << "seed " << seed;
  }
}

TEST(InitializerTest, RejectsPureRotation) {
  const SimulatedFlight flight =
      SimulateFlight(FlightOptions(simulator::Motion::kPureRotation, 1), 4);
  Initializer initializer(ConfigFor(flight));
  EXPECT_FALSE(Feed(flight, &initializer));
  EXPECT_THAT(initializer.reason(), StartsWith("too little parallax: "));
}

// Blank images, whose neighbors a tracker follows from one to the other.
TEST(InitializerTest, StartsWithBlankImagesAtARhythm) {
  for (const size_t rhythm : {2, 3, 10}) {
    SimulatedFlight flight = SimulateFlight(FlightOptions(simulator::Motion::kFast, 1), 4);
    for (size_t i = 1; i < flight.frames.size(); i += rhythm) {
      flight.frames[i].points.points.clear();
    }
    Initializer initializer(ConfigFor(flight));
    const auto start = Feed(flight, &initializer);
    ASSERT_TRUE(start) << rhythm << ": " << initializer.reason();
    EXPECT_LE(start->index, 60u) << rhythm;
    EXPECT_LT(std::abs(ScaleError(*start, flight)), 0.1) << rhythm;
    const auto& frames = start->result.frames;
    for (size_t i = 1; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].measurement.imu.front().t_ns, frames[i - 1].state.t_ns) << rhythm;
    }
  }
}

TEST(InitializerTest, GapInTheImuStartsOver) {
  SimulatedFlight flight = SimulateFlight(FlightOptions(simulator::Motion::kFast, 1), 4);
  constexpr size_t kGap = 10;  // this image is lost, with the samples on both sides of it
  std::vector<FrameMeasurement>& frames = flight.frames;
  frames[kGap + 1].imu = {frames[kGap].imu.front(), frames[kGap + 1].imu.back()};
  frames.erase(frames.begin() + kGap);
  Initializer initializer(ConfigFor(flight));
  const auto start = Feed(flight, &initializer);
  ASSERT_TRUE(start) << initializer.reason();
  EXPECT_GE(start->result.frames.front().state.t_ns, frames[kGap].t_ns);
}

SimulatedFlight ForgetTheCameraPose(SimulatedFlight flight) {
  flight.sensor.cameras[0].T_B_C = Rigid3d();
  flight.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kCalibrateRotation;
  return flight;
}

TEST(InitializerTest, CalibratesTheRotationOfTheCameraFirst) {
  for (const auto motion : {simulator::Motion::kGentle, simulator::Motion::kFast}) {
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      auto options = FlightOptions(motion, seed);
      options.trajectory.duration = 12;
      options.point_outlier_ratio = 0.02;
      const SimulatedFlight truth = SimulateFlight(options);
      const SimulatedFlight flight = ForgetTheCameraPose(truth);
      Initializer initializer(ConfigFor(flight));
      const auto start = Feed(flight, &initializer);
      ASSERT_TRUE(start) << "seed " << seed << ": " << initializer.reason();
      const Rigid3d& T_B_C = start->result.T_B_C.front();
      EXPECT_LT(T_B_C.rotation.angularDistance(truth.sensor.cameras[0].T_B_C.rotation), 0.04)
          << "seed " << seed;
      EXPECT_EQ(T_B_C.translation, Eigen::Vector3d::Zero());
      EXPECT_LT(std::abs(ScaleError(*start, flight)), 0.25) << "seed " << seed;
    }
  }
}

// The rotation is unobservable at standstill and in flight without rotations, and there is no start
// without it.
TEST(InitializerTest, WaitsForTurnsWhereTheCameraRotationIsUnknown) {
  const SimulatedFlight still =
      ForgetTheCameraPose(SimulateFlight(FlightOptions(simulator::Motion::kStill, 1)));
  Initializer initializer(ConfigFor(still));
  EXPECT_FALSE(Feed(still, &initializer));
  EXPECT_THAT(initializer.reason(), HasSubstr("calibrating the camera's rotation"));
}

}  // namespace
}  // namespace plm_vins
