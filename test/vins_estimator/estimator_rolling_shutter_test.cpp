// SPDX-License-Identifier: BSD-3-Clause
// A rolling shutter costs little accuracy if it is modeled, and much if not.
#include <gtest/gtest.h>

#include "test/vins_estimator/estimated_flight.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::SimulatedFlight;

constexpr uint64_t kShutterSeeds = 3;
constexpr double kReadout = 0.03;  // [s]

simulator::FeatureSimulationOptions Options(uint64_t seed, bool rolling_shutter) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = 15;
  options.max_points = 80;
  options.sensors.rolling_shutter = rolling_shutter;
  options.sensors.rolling_shutter_tr = kReadout;
  return options;
}

double ErrorOf(const SimulatedFlight& simulated) {
  const EstimatedFlight flight = testing::Estimate(simulated);
  EXPECT_TRUE(flight.restarts.empty());
  EXPECT_GT(flight.truth.size(), 230u) << "late start";
  return testing::AbsoluteError(flight);
}

TEST(EstimatorRollingShutterTest, CostsLittleIfConfigured) {
  double global = 0, known = 0, ignored = 0;
  for (uint64_t seed = 1; seed <= kShutterSeeds; ++seed) {
    global += ErrorOf(testing::SimulateFlight(Options(seed, false))) / kShutterSeeds;
    SimulatedFlight rolling = testing::SimulateFlight(Options(seed, true));
    known += ErrorOf(rolling) / kShutterSeeds;
    rolling.sensor.rolling_shutter = false;
    ignored += ErrorOf(rolling) / kShutterSeeds;
  }
  EXPECT_LT(known, 1.2 * global);
  EXPECT_GT(ignored, 2 * global);
}

}  // namespace
}  // namespace plm_vins
