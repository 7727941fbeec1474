// SPDX-License-Identifier: BSD-3-Clause
// The estimator with an accelerometer whose bias is that of a cheap IMU.
#include <gtest/gtest.h>

#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"

namespace plm_vins {
namespace {

// The accelerometer of a RealSense D435i [m/s^2].
const Eigen::Vector3d kBias(0.38, -0.13, -0.43);

// Moves from `begin` [s] on; images start at zero.
testing::EstimatedFlight Fly(double begin, double bias_deviation) {
  testing::FlightPlan plan;
  plan.duration = 15;
  plan.T_W_V = [begin](double t) { return testing::GentleFlight(t, begin, 40); };
  auto flight = testing::PlannedFlight(plan).Simulate();
  for (FrameMeasurement& frame : flight.frames) {
    for (ImuSample& sample : frame.imu) sample.accel += kBias;
  }
  for (FrameState& state : flight.truth) state.accel_bias() = kBias;
  Config config = testing::ConfigFor(flight);
  config.sensor.accel_bias_deviation = bias_deviation;
  Estimator estimator(config);
  return testing::Estimate(flight, &estimator);
}

// Starts at standstill and in motion.
class EstimatorAccelBias : public ::testing::TestWithParam<double> {};

// The default suffices as well, since the part along gravity, which shows at standstill, widens it.
TEST_P(EstimatorAccelBias, IsEstimatedWithinItsStatedDeviation) {
  for (const double deviation : {SensorConfig().accel_bias_deviation, 0.5}) {
    const auto flight = Fly(GetParam(), deviation);
    EXPECT_TRUE(flight.restarts.empty()) << flight.restarts.front();
    ASSERT_GT(flight.outputs.size(), 200u);
    const auto bias = flight.outputs.back().state.bias();
    EXPECT_LT((bias.accel - kBias).norm(), 0.02) << bias.accel.transpose();
    EXPECT_LT(testing::GreatestError(flight, 0), GetParam() > 0 ? 0.04 : 0.1);  // as stated
    for (size_t i = 0; i < flight.outputs.size(); i += 20) {
      const testing::Consistency nees = testing::MeasureConsistencyAt(flight, i);
      EXPECT_LT(nees.pose, 16) << i;  // 98.6 % of six degrees of freedom
      EXPECT_LT(nees.biases, 16) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Starts, EstimatorAccelBias, ::testing::Values(3.0, -3.0));

}  // namespace
}  // namespace plm_vins
