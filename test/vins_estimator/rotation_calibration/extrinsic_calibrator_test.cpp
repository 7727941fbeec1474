// SPDX-License-Identifier: BSD-3-Clause
// The camera's rotation from simulated flights, by the calibrator alone and in the estimator.
#include "vins_estimator/rotation_calibration/extrinsic_calibrator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "test/vins_estimator/estimated_flight.h"

namespace plm_vins {
namespace {

using simulator::Motion;
using testing::FlightOptions;
using testing::SimulatedFlight;
using testing::SimulateFlight;

constexpr double kDegree = M_PI / 180;

struct Calibration {
  std::optional<Eigen::Quaterniond> R_B_C;
  std::string reason;  // the last reason
};

Calibration Calibrate(const SimulatedFlight& flight) {
  ExtrinsicCalibrator calibrator(flight.sensor.imu_noise, 0.5 / 460);
  Calibration result;
  std::deque<FrameMeasurement> frames;
  for (const FrameMeasurement& frame : flight.frames) {
    frames.push_back(frame);
    result.R_B_C = calibrator.Add(frames, &result.reason);
    if (result.R_B_C) break;
  }
  return result;
}

TEST(ExtrinsicCalibratorTest, FindsTheRotationInFlight) {
  for (const Motion motion : {Motion::kGentle, Motion::kFast}) {
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      auto options = FlightOptions(motion, seed);
      options.trajectory.duration = 12;
      options.point_outlier_ratio = 0.05;
      const SimulatedFlight flight = SimulateFlight(options);
      const Calibration calibration = Calibrate(flight);
      ASSERT_TRUE(calibration.R_B_C) << "seed " << seed << ": " << calibration.reason;
      EXPECT_LT(calibration.R_B_C->angularDistance(flight.sensor.cameras[0].T_B_C.rotation),
                2.5 * kDegree)
          << "seed " << seed;
    }
  }
}

// A tracker that fails for two seconds; all its points coincide, so they contain no information.
TEST(ExtrinsicCalibratorTest, PointsInOnePlaceDoNoHarm) {
  auto options = FlightOptions(Motion::kFast, 1);
  options.trajectory.duration = 12;
  SimulatedFlight flight = SimulateFlight(options);
  for (size_t i = 0; i < 40; ++i) {
    for (PointObservation& point : flight.frames[i].points.points) {
      point.xy = {0.1 * std::sin(i), 0.1 * std::cos(i)};
    }
  }
  const Calibration calibration = Calibrate(flight);
  ASSERT_TRUE(calibration.R_B_C) << calibration.reason;
  EXPECT_LT(calibration.R_B_C->angularDistance(flight.sensor.cameras[0].T_B_C.rotation),
            2.5 * kDegree);
}

TEST(ExtrinsicCalibratorTest, RejectsAFlightThatDoesNotTurn) {
  auto options = FlightOptions(Motion::kCorridor, 1);
  options.trajectory.lead_in = 0;
  for (const Motion motion : {Motion::kCorridor, Motion::kStill}) {
    options.trajectory.motion = motion;
    const Calibration calibration = Calibrate(SimulateFlight(options));
    EXPECT_FALSE(calibration.R_B_C);
    EXPECT_FALSE(calibration.reason.empty());
  }
}

TEST(ExtrinsicCalibratorTest, RejectsTheGyroOfAnotherFlight) {
  SimulatedFlight flight = SimulateFlight(FlightOptions(Motion::kFast, 1));
  const SimulatedFlight other = SimulateFlight(FlightOptions(Motion::kFast, 2));
  for (size_t i = 0; i < flight.frames.size(); ++i) flight.frames[i].imu = other.frames[i].imu;
  EXPECT_FALSE(Calibrate(flight).R_B_C);
}

SimulatedFlight FlightToCalibrateIn() {
  auto options = FlightOptions(Motion::kGentle, 1);
  options.trajectory.duration = 15;
  options.trajectory.rest = 2;  // must not start before the rotation is known
  options.max_points = 80;
  return SimulateFlight(options);
}

Config WithoutCameraPose(const SimulatedFlight& flight) {
  Config config = testing::ConfigFor(flight);
  config.sensor.cameras[0].T_B_C = Rigid3d();
  config.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kCalibrateRotation;
  return config;
}

// The whole estimator, with unknown extrinsics.
TEST(ExtrinsicCalibratorTest, EstimatorStartsWithoutAnyCameraPose) {
  const SimulatedFlight flight = FlightToCalibrateIn();
  Estimator estimator(WithoutCameraPose(flight));
  const testing::EstimatedFlight estimated = testing::Estimate(flight, &estimator);
  EXPECT_TRUE(estimated.restarts.empty());
  ASSERT_GT(estimated.truth.size(), 100u);
  EXPECT_GT(estimated.truth.front().t_ns, flight.truth[80].t_ns);
  EXPECT_LT(testing::AbsoluteError(estimated), 0.03);
  const Rigid3d error = estimated.outputs.back().calibration.cameras[0].T_B_C.Inverse() *
                        flight.sensor.cameras[0].T_B_C;
  EXPECT_LT(error.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.2 * kDegree);
  EXPECT_LT(error.translation.norm(), 0.04);
}

TEST(ExtrinsicCalibratorTest, TheRotationSurvivesALoss) {
  const SimulatedFlight flight = FlightToCalibrateIn();
  Estimator estimator(WithoutCameraPose(flight));
  size_t i = 0;
  EstimatorOutput output;
  for (; i < 200; ++i) output = estimator.Process(flight.frames[i]);
  ASSERT_TRUE(output.has_pose) << output.reason;
  FrameMeasurement broken = flight.frames[i++];
  broken.imu[1].accel_doubt = 1e160;
  EXPECT_EQ(estimator.Process(broken).status, EstimatorStatus::kLost);
  for (output = {}; !output.has_pose && i < 260; ++i) {
    output = estimator.Process(flight.frames[i]);
    EXPECT_EQ(output.reason.find("calibrating"), std::string::npos) << output.reason;
  }
  ASSERT_TRUE(output.has_pose) << output.reason;
  EXPECT_LT(output.calibration.cameras[0].T_B_C.rotation.angularDistance(
                flight.sensor.cameras[0].T_B_C.rotation),
            2.5 * kDegree);
  estimator.Reset();
  output = estimator.Process(flight.frames[i]);
  output = estimator.Process(flight.frames[i + 1]);
  EXPECT_NE(output.reason.find("calibrating"), std::string::npos) << output.reason;
}

}  // namespace
}  // namespace plm_vins
