// SPDX-License-Identifier: BSD-3-Clause
// The benefit of each stage for lines on long flights. The bounds are the ratios of mean errors in
// 24 flights (16 for the Manhattan frame) plus two standard deviations of the ratio, by bootstrap,
// for the number of flights here (one and a half for the Manhattan frame).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/geometry/so3.h"
#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

// Line tracks end often, as in real images, so that many lines are re-observed.
testing::SimulatedFlight SimulateLongFlight(uint64_t seed, double duration) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = duration;
  options.max_points = 40;
  options.max_lines = 40;
  options.line_break_probability = 0.05;
  return testing::SimulateFlight(options);
}

std::vector<testing::SimulatedFlight> SimulateLongFlights(int count, double duration) {
  std::vector<testing::SimulatedFlight> flights;
  flights.reserve(count);
  for (int seed = 1; seed <= count; ++seed) flights.push_back(SimulateLongFlight(seed, duration));
  return flights;
}

// Root mean square heading error from the beginning of the flight on [rad].
double HeadingError(const testing::EstimatedFlight& flight) {
  const Rigid3d T = testing::AlignHeading(flight.anchor, flight.true_anchor);
  double sum = 0;
  for (size_t i = 0; i < flight.truth.size(); ++i) {
    const Eigen::Quaterniond estimated = T.rotation * flight.outputs[i].state.rotation();
    sum += std::pow(SO3Log(estimated * flight.truth[i].rotation().conjugate()).z(), 2);
  }
  return std::sqrt(sum / static_cast<double>(flight.truth.size()));
}

// Means over the flights.
struct Errors {
  double position = 0;  // [m]
  double heading = 0;   // [rad]
};

class EstimatorStages : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flights_ = SimulateLongFlights(8, 50);
    with_all_ = MeanErrors(flights_, [](EstimatorConfig*) {});
  }

  static void TearDownTestSuite() { flights_.clear(); }

  static Errors MeanErrors(const std::vector<testing::SimulatedFlight>& flights,
                           void (*change)(EstimatorConfig*)) {
    const auto count = static_cast<double>(flights.size());
    Errors mean;
    for (const testing::SimulatedFlight& flight : flights) {
      Config config = testing::ConfigFor(flight);
      config.estimator.line_noise = simulator::FeatureSimulationOptions().line_noise_px;
      change(&config.estimator);
      Estimator estimator(config);
      const testing::EstimatedFlight estimated = testing::Estimate(flight, &estimator);
      mean.position += testing::AbsoluteError(estimated) / count;
      mean.heading += HeadingError(estimated) / count;
    }
    return mean;
  }

  static std::vector<testing::SimulatedFlight> flights_;
  static Errors with_all_;
};

std::vector<testing::SimulatedFlight> EstimatorStages::flights_;
Errors EstimatorStages::with_all_;

TEST_F(EstimatorStages, LinesReduceTheError) {
  std::vector<testing::SimulatedFlight> flights;
  flights.reserve(flights_.size());
  for (const auto& flight : flights_) flights.push_back(testing::WithoutLines(flight));
  const Errors without = MeanErrors(flights, [](EstimatorConfig*) {});
  EXPECT_LT(with_all_.position, 0.85 * without.position);
}

TEST_F(EstimatorStages, MergingReducesTheError) {
  const auto without = MeanErrors(flights_, [](EstimatorConfig* c) { c->line_merging = false; });
  EXPECT_LT(with_all_.position, 0.91 * without.position);
}

TEST_F(EstimatorStages, AnchorsReduceTheError) {
  const auto without = MeanErrors(flights_, [](EstimatorConfig* c) { c->line_anchors = 0; });
  EXPECT_LT(with_all_.position, 0.95 * without.position);
}

// Tested without anchors: with anchors, recognized lines constrain the heading as well, and the
// Manhattan frame adds nothing measurable in 24 flights of 50 s or 16 of 150 s.
TEST_F(EstimatorStages, ManhattanFrameReducesHeadingDrift) {
  const auto flights = SimulateLongFlights(6, 150);
  const auto with = MeanErrors(flights, [](EstimatorConfig* c) { c->line_anchors = 0; });
  const auto without = MeanErrors(flights, [](EstimatorConfig* c) {
    c->line_anchors = 0;
    c->manhattan_constraints = false;
  });
  EXPECT_LT(with.heading, 0.85 * without.heading);
  EXPECT_LT(with.position, 1.03 * without.position);  // within the precision
}

}  // namespace
}  // namespace plm_vins
