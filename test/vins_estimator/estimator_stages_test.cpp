// SPDX-License-Identifier: BSD-3-Clause
// What each stage that works on lines is worth on long flights. Single flights differ by a third
// either way, the means by about a tenth; the margins are half of what the stages gain there.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/so3.h"
#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/estimator.h"

namespace plm_vins {
namespace {

constexpr int kFlights = 6;

// Tracks of lines end often, as in real images, so that many are seen again.
testing::SimulatedFlight SimulateLongFlight(uint64_t seed) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = 50;
  options.max_points = 40;
  options.max_lines = 40;
  options.line_break_probability = 0.05;
  return testing::SimulateFlight(options);
}

// Root mean square of the heading's error, from the beginning of the flight on [rad].
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
    for (int seed = 1; seed <= kFlights; ++seed) flights_.push_back(SimulateLongFlight(seed));
    with_all_ = MeanErrors(flights_, [](EstimatorConfig*) {});
  }

  static void TearDownTestSuite() { flights_.clear(); }

  static Errors MeanErrors(const std::vector<testing::SimulatedFlight>& flights,
                           void (*change)(EstimatorConfig*)) {
    Errors mean;
    for (const testing::SimulatedFlight& flight : flights) {
      Config config = testing::ConfigFor(flight);
      config.estimator.line_noise = simulator::FeatureSimulationOptions().line_noise_px;
      change(&config.estimator);
      Estimator estimator(config);
      const testing::EstimatedFlight estimated = testing::Estimate(flight, &estimator);
      mean.position += testing::AbsoluteError(estimated) / kFlights;
      mean.heading += HeadingError(estimated) / kFlights;
    }
    return mean;
  }

  static std::vector<testing::SimulatedFlight> flights_;
  static Errors with_all_;
};

std::vector<testing::SimulatedFlight> EstimatorStages::flights_;
Errors EstimatorStages::with_all_;

TEST_F(EstimatorStages, LinesHelp) {
  std::vector<testing::SimulatedFlight> flights;
  flights.reserve(flights_.size());
  for (const auto& flight : flights_) flights.push_back(testing::WithoutLines(flight));
  const Errors without = MeanErrors(flights, [](EstimatorConfig*) {});
  EXPECT_LT(with_all_.position, 0.86 * without.position);
}

TEST_F(EstimatorStages, MergingHelps) {
  const auto without = MeanErrors(flights_, [](EstimatorConfig* c) { c->line_merging = false; });
  EXPECT_LT(with_all_.position, 0.88 * without.position);
}

TEST_F(EstimatorStages, AnchorsHelp) {
  const auto without = MeanErrors(flights_, [](EstimatorConfig* c) { c->line_anchors = 0; });
  EXPECT_LT(with_all_.position, 0.89 * without.position);
}

// It holds the heading only, which is a small part of the position's error.
TEST_F(EstimatorStages, TheManhattanFrameHelpsTheHeading) {
  const auto without =
      MeanErrors(flights_, [](EstimatorConfig* c) { c->manhattan_constraints = false; });
  EXPECT_LT(with_all_.heading, 0.96 * without.heading);
  EXPECT_LT(with_all_.position, 1.03 * without.position);
}

}  // namespace
}  // namespace plm_vins
