// SPDX-License-Identifier: BSD-3-Clause
// The whole estimator in simulated worlds: accuracy, consistency and calibration. For disturbances
// see estimator_robustness_test.cpp.
#include "vins_estimator/estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;
using simulator::Motion;
using testing::EstimatedFlight;
using testing::SimulatedFlight;

simulator::FeatureSimulationOptions Options(Motion motion, uint64_t seed, double duration = 15) {
  auto options = testing::FlightOptions(motion, seed);
  options.trajectory.duration = duration;
  options.max_points = 80;
  return options;
}

EstimatedFlight Fly(const simulator::FeatureSimulationOptions& options) {
  return testing::Estimate(testing::SimulateFlight(options));
}

TEST(EstimatorTest, IsAccurateAndConsistentInFlight) {
  struct Case {
    Motion motion;
    double max_error;  // relative to the path
  };
  for (const auto& [motion, max_error] : {Case{Motion::kGentle, 0.003}, {Motion::kFast, 0.001}}) {
    SCOPED_TRACE(motion == Motion::kFast ? "fast" : "gentle");
    constexpr uint64_t kSeeds = 3;
    testing::Consistency mean;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const EstimatedFlight flight = Fly(Options(motion, seed));
      EXPECT_TRUE(flight.restarts.empty());
      EXPECT_GE(flight.truth.size(), 250u) << "late start";
      EXPECT_LT(testing::AbsoluteError(flight), max_error * flight.path) << "seed " << seed;
      const testing::Consistency consistency = testing::MeasureConsistency(flight);
      mean.pose += consistency.pose / kSeeds;
      mean.velocity += consistency.velocity / kSeeds;
    }
    // Exact consistency would be 6 and 3. Measured: 7.3 and 4.6 (gentle), 4.3 and 3.2 (fast).
    EXPECT_GT(mean.pose, 2);
    EXPECT_LT(mean.pose, 11);
    EXPECT_GT(mean.velocity, 1);
    EXPECT_LT(mean.velocity, 7);
  }
}

TEST(EstimatorTest, OutliersCostLittle) {
  for (const double share : {0.05, 0.1}) {
    auto options = Options(Motion::kFast, 1);
    options.point_outlier_ratio = share;
    const EstimatedFlight flight = Fly(options);
    EXPECT_TRUE(flight.restarts.empty());
    EXPECT_GE(flight.truth.size(), 250u);
    EXPECT_LT(testing::AbsoluteError(flight), 0.001 * flight.path) << share;
  }
}

// Corners that jump in one image look like motion, which would release the state until the next
// keyframe.
TEST(EstimatorTest, HoldsPositionAtStandstillDespiteMovingImages) {
  SimulatedFlight still = testing::SimulateFlight(Options(Motion::kStill, 1));
  const EstimatedFlight undisturbed = testing::Estimate(still);
  for (PointObservation& point : still.frames[105].points.points) point.uv_px.x() += 3;
  const EstimatedFlight flight = testing::Estimate(still);
  ASSERT_EQ(flight.outputs.size(), undisturbed.outputs.size());
  int seem_to_move = 0;
  for (size_t i = 0; i < flight.outputs.size(); ++i) {
    const EstimatorOutput &output = flight.outputs[i], &expected = undisturbed.outputs[i];
    seem_to_move += expected.stationary && !output.stationary ? 1 : 0;
    EXPECT_LT((output.state.position() - expected.state.position()).norm(), 0.002) << i;
  }
  EXPECT_GE(seem_to_move, 2) << "there, and where another is compared with it";
}

// Corners with 0.5 px of noise seem to move now and then, which ends the standstill for an image.
TEST(EstimatorTest, HoldsPositionAtStandstill) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const EstimatedFlight flight = Fly(Options(Motion::kStill, seed));
    EXPECT_TRUE(flight.restarts.empty());
    ASSERT_GT(flight.truth.size(), 250u);
    EXPECT_LT(testing::GreatestError(flight, 0), 0.003) << seed;
    int stationary = 0;
    for (const EstimatorOutput& output : flight.outputs) {
      stationary += output.stationary;
      EXPECT_LT(output.state.velocity().norm(), 0.01);
    }
    EXPECT_GT(stationary, 0.7 * static_cast<double>(flight.truth.size())) << seed;
    EXPECT_TRUE(flight.outputs.front().stationary);
    EXPECT_FALSE(flight.outputs.front().on_imu_alone);
  }
}

TEST(EstimatorTest, HoldsPositionInHover) {
  auto options = Options(Motion::kHover, 1);
  options.trajectory.lead_in = 5;
  const EstimatedFlight flight = Fly(options);
  EXPECT_TRUE(flight.restarts.empty());
  ASSERT_GT(flight.truth.size(), 250u);
  EXPECT_LT(testing::AbsoluteError(flight), 0.02);
  EXPECT_LT(testing::GreatestError(flight, 150), 0.03);  // the last seven seconds
}

TEST(EstimatorTest, LearnsTheRotationOfTheCamera) {
  SimulatedFlight simulated = testing::SimulateFlight(Options(Motion::kFast, 1));
  const Eigen::Quaterniond truth = simulated.sensor.cameras[0].T_B_C.rotation;
  const Vector3d error = Vector3d(1, -1, 1).normalized() * M_PI / 180;
  simulated.sensor.cameras[0].T_B_C.rotation = truth * SO3Exp(error);
  simulated.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kRefine;
  const EstimatedFlight flight = testing::Estimate(simulated);
  EXPECT_TRUE(flight.restarts.empty());
  ASSERT_GT(flight.truth.size(), 200u);
  const Eigen::Quaterniond& learned = flight.outputs.back().calibration.cameras[0].T_B_C.rotation;
  EXPECT_LT(learned.angularDistance(truth), 0.1 * M_PI / 180);
  EXPECT_LT(testing::AbsoluteError(flight), 0.003 * flight.path);
}

// Learns the time offset [s] in a flight; IMU intervals use the current estimate, as in operation.
double LearnTimeOffset(const simulator::FeatureSimulationOptions& options) {
  const simulator::FeatureDataset data = simulator::SimulateFeatures(options);
  Config config;
  config.sensor = options.sensors;
  config.sensor.td = 0;
  config.sensor.estimate_td = true;
  config.estimator.point_noise = options.point_noise_px;
  EstimationStage stage(config);
  for (const ImuSample& sample : data.imu) stage.AddImu(sample);
  double learned = 0;
  for (const PointFrame& points : data.points) {
    stage.AddPoints(points);
    while (const auto frame = stage.Pop()) {
      EXPECT_FALSE(frame->output.restarted);
      if (frame->output.has_pose) learned = frame->output.calibration.td;
    }
  }
  return learned;
}

TEST(EstimatorTest, LearnsTheTimeOffset) {
  auto options = Options(Motion::kFast, 1);
  options.sensors.td = 0.01;
  options.point_noise_px = 0.1;
  EXPECT_NEAR(LearnTimeOffset(options), 0.01, 0.001);
  options.sensors.td = 0.025;  // large enough for its errors to be confused with IMU noise
  EXPECT_NEAR(LearnTimeOffset(options), 0.025, 0.002);
  options.sensors.td = 0.01;
  // The velocity of a corner is a difference from the previous image, so it shares noise with the
  // corner. This biases the offset by one to five milliseconds at half a pixel.
  options.point_noise_px = 0.5;
  EXPECT_NEAR(LearnTimeOffset(options), 0.01, 0.005);
}

TEST(EstimatorTest, ASmallWindowHasItsSizeAfterAnyStart) {
  const SimulatedFlight simulated = testing::SimulateFlight(Options(Motion::kFast, 1, 6));
  Config config = testing::ConfigFor(simulated);
  config.estimator.window_size = 6;
  Estimator estimator(config);
  const EstimatedFlight flight = testing::Estimate(simulated, &estimator);
  ASSERT_GT(flight.outputs.size(), 50u);
  EXPECT_EQ(flight.outputs.back().window.size(), 7u);  // including the newest image
}

TEST(EstimatorTest, DescribesItsWindow) {
  const EstimatedFlight flight = Fly(Options(Motion::kGentle, 1, 8));
  const EstimatorOutput& output = flight.outputs.back();
  EXPECT_EQ(output.status, EstimatorStatus::kTracking);
  EXPECT_TRUE(output.reason.empty());
  EXPECT_EQ(output.window.size(), EstimatorConfig().window_size + 1u);
  EXPECT_EQ(output.window.back().t_ns, output.t_ns);
  EXPECT_EQ(output.window.back().pose, output.state.pose);
  for (size_t i = 1; i < output.window.size(); ++i) {
    EXPECT_GT(output.window[i].t_ns, output.window[i - 1].t_ns);
  }
  EXPECT_EQ(output.counts.points_observed, 80);
  EXPECT_GT(output.counts.points_in_window, 50);
  EXPECT_GT(output.points.size(), 50u);
}

}  // namespace
}  // namespace plm_vins
