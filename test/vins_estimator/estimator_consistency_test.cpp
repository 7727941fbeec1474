// SPDX-License-Identifier: BSD-3-Clause
// Whether the covariances that the estimator states are those of its errors, with each of the
// stages that work on lines.
#include <gtest/gtest.h>

#include <iostream>
#include <utility>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

constexpr int kFlights = 20;

// Bounds of the mean of a chi-squared variable over the flights, two-sided 95 %.
struct Bounds {
  double low, high;
};
constexpr Bounds kSixFree = {91.57 / kFlights, 152.21 / kFlights};   // 120 degrees of freedom
constexpr Bounds kThreeFree = {40.48 / kFlights, 83.30 / kFlights};  // 60

struct Stages {
  const char* name;
  bool lines, merging, manhattan;
  int anchors;
};

void PrintTo(const Stages& stages, std::ostream* stream) { *stream << stages.name; }

testing::EstimatedFlight Fly(const Stages& stages, uint64_t seed) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = 12;
  options.max_points = 80;
  options.max_lines = 40;
  options.line_break_probability = 0.02;
  testing::SimulatedFlight flight = testing::SimulateFlight(options);
  if (!stages.lines) flight = testing::WithoutLines(std::move(flight));
  Config config = testing::ConfigFor(flight);
  config.estimator.line_noise = options.line_noise_px;
  config.estimator.line_merging = stages.merging;
  config.estimator.manhattan_constraints = stages.manhattan;
  config.estimator.line_anchors = stages.anchors;
  Estimator estimator(config);
  return testing::Estimate(flight, &estimator);
}

void ExpectWithin(const Bounds& bounds, double sum, const char* what) {
  EXPECT_GT(sum / kFlights, bounds.low) << what;
  EXPECT_LT(sum / kFlights, bounds.high) << what;
}

class EstimatorConsistency : public ::testing::TestWithParam<Stages> {};

// Errors at the ends of flights, which know nothing of each other.
TEST_P(EstimatorConsistency, ErrorsAreAsLargeAsStated) {
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

INSTANTIATE_TEST_SUITE_P(AllStages, EstimatorConsistency,
                         ::testing::Values(Stages{"points", false, false, false, 0},
                                           Stages{"lines", true, false, false, 0},
                                           Stages{"merging", true, true, false, 0},
                                           Stages{"manhattan", true, true, true, 0},
                                           Stages{"anchors", true, true, true, 24}));

}  // namespace
}  // namespace plm_vins
