// SPDX-License-Identifier: BSD-3-Clause
// Estimation with a second camera or with measured depth.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator_options.h"
#include "vins_estimator/geometry/depth_slopes.h"
#include "vins_estimator/initialization/initializer.h"
#include "vins_estimator/window_odometry.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::SimulatedFlight;

// A gentle flight with an accelerometer as noisy as propellers make it, which hardly tells the
// scale.
simulator::FeatureSimulationOptions GentleFlight(uint64_t seed, double duration = 15) {
  auto options = testing::FlightOptions(simulator::Motion::kGentle, seed);
  options.trajectory.duration = duration;
  options.max_points = 80;
  options.sensors.imu_noise.accel_density = 0.03;
  return options;
}

SimulatedFlight StereoFlight(uint64_t seed, double outlier_ratio = 0, double duration = 15) {
  auto options = GentleFlight(seed, duration);
  options.sensors.cameras = simulator::DefaultStereoSensors().cameras;
  options.second_outlier_ratio = outlier_ratio;
  return testing::WithoutLines(testing::SimulateFlight(options, /*skip=*/1));
}

void RemoveSecondCamera(PointFrame* frame) {
  std::vector<PointObservation>& points = frame->points;
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const PointObservation& point) { return point.camera == 1; }),
               points.end());
}

SimulatedFlight WithoutSecondCamera(SimulatedFlight flight) {
  flight.sensor.cameras.resize(1);
  for (FrameMeasurement& frame : flight.frames) RemoveSecondCamera(&frame.points);
  return flight;
}

Rigid3d SecondInFirst(const SensorConfig& sensor) {
  return sensor.cameras[0].T_B_C.Inverse() * sensor.cameras[1].T_B_C;
}

// Turns the second camera of the configuration.
void TurnSecondCamera(const Eigen::Vector3d& theta, SensorConfig* sensor) {
  Rigid3d& T_B_C1 = sensor->cameras[1].T_B_C;
  T_B_C1.rotation = T_B_C1.rotation * SO3Exp(theta);
}

double FirstPose(const SimulatedFlight& flight, const EstimatedFlight& estimated) {
  return ToSeconds(estimated.outputs.front().t_ns - flight.frames.front().t_ns);
}

// Mean absolute error over some flights [m].
template <typename Fly>
double MeanError(const Fly& fly) {
  constexpr int kFlights = 4;
  double sum = 0;
  for (uint64_t seed = 1; seed <= kFlights; ++seed) {
    const EstimatedFlight flight = fly(seed);
    EXPECT_TRUE(flight.restarts.empty());
    sum += testing::AbsoluteError(flight) / kFlights;
  }
  return sum;
}

// Both are needed by several tests, but estimated once.
double StereoError() {
  static const double error =
      MeanError([](uint64_t seed) { return testing::Estimate(StereoFlight(seed)); });
  return error;
}

double MonocularError() {
  static const double error = MeanError(
      [](uint64_t seed) { return testing::Estimate(WithoutSecondCamera(StereoFlight(seed))); });
  return error;
}

TEST(EstimatorStereo, ASecondCameraOrDepthHasLessErrorThanOneCamera) {
  const double stereo = StereoError(), monocular = MonocularError();
  const double depth = MeanError([](uint64_t seed) {
    auto options = GentleFlight(seed);
    options.sensors.depth.emplace();
    return testing::Estimate(testing::WithoutLines(testing::SimulateFlight(options, /*skip=*/1)));
  });
  EXPECT_LT(stereo, 0.8 * monocular);
  EXPECT_LT(depth, 0.8 * monocular);
}

TEST(EstimatorStereo, StartsInMotionWithinSixTenthsOfASecond) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const SimulatedFlight flight = StereoFlight(seed, /*outlier_ratio=*/0, /*duration=*/3);
    const EstimatedFlight estimated = testing::Estimate(flight);
    EXPECT_LE(FirstPose(flight, estimated), 0.6);
    const FrameState& first = estimated.outputs.front().state;
    EXPECT_LT(testing::GravityError(first, estimated.truth.front()), 0.04);
    EXPECT_LT(testing::VelocityError(first, estimated.truth.front()), 0.1);
  }
}

TEST(EstimatorStereo, StartsAtStandstillWithinThreeTenthsOfASecond) {
  auto options = GentleFlight(1, /*duration=*/4);
  options.sensors.cameras = simulator::DefaultStereoSensors().cameras;
  options.trajectory.rest = 2;
  const SimulatedFlight flight = testing::SimulateFlight(options);
  EXPECT_LE(FirstPose(flight, testing::Estimate(flight)), 0.3);
}

TEST(EstimatorStereo, WrongMatchesCostLittle) {
  const double with_outliers = MeanError(
      [](uint64_t seed) { return testing::Estimate(StereoFlight(seed, /*outlier_ratio=*/0.2)); });
  EXPECT_LT(with_outliers, 1.4 * StereoError());
}

TEST(EstimatorStereo, EstimatesTheRotationOfTheSecondCamera) {
  SimulatedFlight flight = StereoFlight(1);
  const Rigid3d truth = SecondInFirst(flight.sensor);
  TurnSecondCamera({0.003, -0.003, 0.003}, &flight.sensor);
  const EstimatedFlight estimated = testing::Estimate(flight);
  const auto& cameras = estimated.outputs.back().calibration.cameras;
  const Rigid3d found = cameras[0].T_B_C.Inverse() * cameras[1].T_B_C;
  EXPECT_LT(SO3Log(truth.rotation.conjugate() * found.rotation).norm(), 0.0006);
  EXPECT_FALSE(estimated.outputs.back().cameras.at(0).misfit_px);
}

// The second camera shakes against the first.
TEST(EstimatorStereo, MiscalibratedSecondCameraIsReportedAndCostsLittle) {
  const double error = MeanError([](uint64_t seed) {
    SimulatedFlight flight = StereoFlight(seed);
    simulator::Random random(seed);
    for (FrameMeasurement& frame : flight.frames) {
      const Eigen::Vector2d shift(0.02 * random.Normal(), 0.02 * random.Normal());
      for (PointObservation& point : frame.points.points) {
        if (point.camera == 1) point.xy += shift;
      }
    }
    EstimatedFlight estimated = testing::Estimate(flight);
    EXPECT_TRUE(estimated.outputs.back().cameras.at(0).misfit_px);
    return estimated;
  });
  EXPECT_LT(error, 1.25 * MonocularError());
}

TEST(EstimatorStereo, ReportsAWrongBaseline) {
  SimulatedFlight flight = StereoFlight(1);
  Rigid3d T_C0_C1 = SecondInFirst(flight.sensor);
  T_C0_C1.translation *= 1 / 1.1;
  flight.sensor.cameras[1].T_B_C = flight.sensor.cameras[0].T_B_C * T_C0_C1;
  const auto error = testing::Estimate(flight).outputs.back().cameras.at(0).baseline;
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->error, 0.1, 0.06);
}

// Counts the images at standstill in which the depth of the scene is considered known.
int ImagesWithKnownDepth(const SimulatedFlight& flight, double rest) {
  Config config;
  config.sensor = flight.sensor;
  const EstimatorOptions options(config);
  Initializer initializer(config);
  WindowOdometry odometry(config, options);
  int known = 0;
  for (const FrameMeasurement& frame : flight.frames) {
    if (ToSeconds(frame.t_ns - flight.frames.front().t_ns) > rest) break;
    if (odometry.started()) {
      odometry.Track(frame, std::nullopt, static_cast<int>(frame.points.points.size()));
    } else if (const auto result = initializer.Add(frame)) {
      odometry.Start(*result, UncertaintyOf(config.sensor, result->from_standstill));
    }
    known += odometry.MedianDepth().has_value();
  }
  return known;
}

// Noise triangulates points arbitrarily near until the body moves.
TEST(EstimatorStereo, KnowsNoDepthAtRestIfTheSecondCameraDeliversNothing) {
  auto options = GentleFlight(1, /*duration=*/4);
  options.sensors.cameras = simulator::DefaultStereoSensors().cameras;
  options.trajectory.rest = 2;
  SimulatedFlight flight = testing::SimulateFlight(options, /*skip=*/1);
  EXPECT_GT(ImagesWithKnownDepth(flight, options.trajectory.rest), 5);
  for (FrameMeasurement& frame : flight.frames) RemoveSecondCamera(&frame.points);
  EXPECT_EQ(ImagesWithKnownDepth(flight, options.trajectory.rest), 0);
}

// Returns what the estimator reports about depths that are too long by a factor, late, and read
// beside the point.
DepthFaults FaultsOfDepths(double scale, double delay, const Eigen::Vector2d& shift) {
  auto options = GentleFlight(1);
  options.sensors.imu_noise.accel_density = 0.01;
  options.sensors.depth.emplace();
  SimulatedFlight flight = testing::WithoutLines(testing::SimulateFlight(options, /*skip=*/1));
  for (size_t i = 0; i < flight.frames.size(); ++i) {
    const FrameState& state = flight.truth[i];
    const Eigen::Matrix3d R_W_C = (state.T_W_B() * flight.sensor.cameras[0].T_B_C).R();
    const double approach = R_W_C.col(2).dot(state.velocity());
    PointFrame& frame = flight.frames[i].points;
    const std::vector<Eigen::Vector2d> slopes = DepthSlopes(frame);
    for (size_t k = 0; k < slopes.size(); ++k) {
      PointObservation& point = frame.points[k];
      if (!point.depth) continue;
      const double beside = slopes[k].dot(shift + delay * point.velocity);
      *point.depth = scale / (1 / (*point.depth + delay * approach) + beside);
    }
  }
  return testing::Estimate(flight).outputs.back().depth;
}

TEST(EstimatorStereo, ReportsScaleAndDelayOfMeasuredDepths) {
  constexpr double kScale = 1.06, kDelay = 0.03;
  const DepthFaults faults = FaultsOfDepths(kScale, kDelay, {0, 0});
  ASSERT_TRUE(faults.scale && faults.delay);
  EXPECT_NEAR(faults.scale->error, 0.06, 0.015);
  EXPECT_NEAR(*faults.delay, kDelay, 0.005);
  EXPECT_FALSE(faults.misalignment);
}

TEST(EstimatorStereo, ReportsDepthsThatAreNotAlignedToTheCamera) {
  const DepthFaults faults = FaultsOfDepths(1, 0, {0.02, 0});
  EXPECT_FALSE(faults.delay);
  ASSERT_TRUE(faults.misalignment);
  EXPECT_GT(faults.misalignment->distance_px, 5 * faults.misalignment->deviation_px);
}

}  // namespace
}  // namespace plm_vins
