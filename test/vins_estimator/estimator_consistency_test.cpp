// SPDX-License-Identifier: BSD-3-Clause
// Tests whether the estimator's covariances agree with its errors, without lines and with all
// stages for lines.
#include <gtest/gtest.h>

#include <utility>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

constexpr int kFlights = 20;

// Bounds of the mean of a chi-square variable over the flights, two-sided 95 %.
struct Bounds {
  double low, high;
};
constexpr Bounds kSixFree = {91.57 / kFlights, 152.21 / kFlights};   // 120 degrees of freedom
constexpr Bounds kThreeFree = {40.48 / kFlights, 83.30 / kFlights};  // 60

testing::EstimatedFlight Fly(bool with_lines, uint64_t seed) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = 12;
  options.max_points = 80;
  options.max_lines = 40;
  options.line_break_probability = 0.02;
  testing::SimulatedFlight flight = testing::SimulateFlight(options);
  if (!with_lines) flight = testing::WithoutLines(std::move(flight));
  Config config = testing::ConfigFor(flight);
  config.estimator.line_noise = options.line_noise_px;
  Estimator estimator(config);
  return testing::Estimate(flight, &estimator);
}

void ExpectWithin(const Bounds& bounds, double sum, const char* what) {
  EXPECT_GT(sum / kFlights, bounds.low) << what;
  EXPECT_LT(sum / kFlights, bounds.high) << what;
}

class EstimatorConsistency : public ::testing::TestWithParam<bool> {};

// Errors at the ends of flights, which are independent of each other.
TEST_P(EstimatorConsistency, ErrorsMatchTheCovariance) {
  testing::Consistency sum;
  for (uint64_t seed = 1; seed <= kFlights; ++seed) {
    const testing::EstimatedFlight flight = Fly(GetParam(), seed);
    ASSERT_GT(flight.truth.size(), 150u) << "seed " << seed;
    const auto at_end = testing::MeasureConsistencyAt(flight, flight.truth.size() - 1);
    sum.pose += at_end.pose;
    sum.velocity += at_end.velocity;
    sum.biases += at_end.biases;
  }
  ExpectWithin(kSixFree, sum.pose, "pose");
  ExpectWithin(kThreeFree, sum.velocity, "velocity");
  ExpectWithin(kSixFree, sum.biases, "biases");
}

INSTANTIATE_TEST_SUITE_P(WithLines, EstimatorConsistency, ::testing::Bool());

// Flights with strong vibrations, of which the configuration contains only a share.
class ImuNoiseIsLearned : public ::testing::Test {
 protected:
  struct Result {
    double pose = 0, velocity = 0;               // mean NEES at the ends
    double accel_density = 0, gyro_density = 0;  // mean at the ends, relative to the true ones
  };

  static Result Fly(double configured_share, bool learns) {
    constexpr int kShakenFlights = 4;
    Result mean;
    for (uint64_t seed = 1; seed <= kShakenFlights; ++seed) {
      auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
      options.trajectory.duration = 12;
      options.max_points = 80;
      const ImuNoise truth = {1e-3, 3e-2, 2e-5, 3e-3};
      options.sensors.imu_noise = truth;
      const auto flight = testing::WithoutLines(testing::SimulateFlight(options));
      Config config = testing::ConfigFor(flight);
      config.sensor.imu_noise = Scaled(truth, configured_share * configured_share);
      config.estimator.adapt_imu_noise = learns;
      Estimator estimator(config);
      const testing::EstimatedFlight estimated = testing::Estimate(flight, &estimator);
      const auto at_end = testing::MeasureConsistencyAt(estimated, estimated.truth.size() - 1);
      const ImuNoise& noise = estimated.outputs.back().imu_noise;
      mean.pose += at_end.pose / kShakenFlights;
      mean.velocity += at_end.velocity / kShakenFlights;
      mean.accel_density += noise.accel_density / truth.accel_density / kShakenFlights;
      mean.gyro_density += noise.gyro_density / truth.gyro_density / kShakenFlights;
    }
    return mean;
  }
};

// The gyroscope is so much more precise than images that these contain little information on its
// noise. The accelerometer noise is white here, so the allowance for colored noise is too large.
TEST_F(ImuNoiseIsLearned, WhenConfiguredFourTimesTooSmall) {
  const Result fixed = Fly(0.25, false), learned = Fly(0.25, true);
  EXPECT_GT(learned.accel_density, 1);
  EXPECT_LT(learned.accel_density, 1.5);
  EXPECT_GT(learned.gyro_density, 1.6 * fixed.gyro_density);
  EXPECT_LT(learned.pose, 0.3 * fixed.pose);
  EXPECT_LT(learned.velocity, 0.15 * fixed.velocity);
}

TEST_F(ImuNoiseIsLearned, AndStaysAsConfiguredIfCorrect) {
  const Result learned = Fly(1, true);
  EXPECT_NEAR(learned.accel_density, 1, 0.1);
  EXPECT_NEAR(learned.gyro_density, 1, 0.1);
}

}  // namespace
}  // namespace plm_vins
