// SPDX-License-Identifier: BSD-3-Clause
// The estimator at true and apparent standstill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/vins_estimator/estimated_flight.h"
#include "test/vins_estimator/planned_flight.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::FlightPlan;
using testing::GentleFlight;

EstimatedFlight Fly(const FlightPlan& plan) {
  return testing::Estimate(testing::PlannedFlight(plan).Simulate());
}

// Error of the last position, aligned at an image `duration` seconds before [m].
double ErrorOver(double duration, const EstimatedFlight& flight) {
  const auto images = static_cast<size_t>(duration / 0.05);
  const size_t last = flight.outputs.size() - 1, first = last - images;
  const Rigid3d T = testing::AlignHeading(flight.outputs[first].state, flight.truth[first]);
  return (T * Eigen::Vector3d(flight.outputs[last].state.position()) -
          flight.truth[last].position())
      .norm();
}

// Motion too slow for the IMU, and within a pixel in half a second for the camera.
TEST(EstimatorStandstill, ACreepingFlightIsNotHeldInPlace) {
  for (const double v : {0.02, 0.05}) {
    FlightPlan plan;
    plan.duration = 40;
    plan.room = {40, 40, 20};
    plan.T_W_V = [v](double t) {
      Rigid3d T_W_V = GentleFlight(t, 2, 12);
      const double s = std::max(0.0, t - 14);  // slow motion from then on
      T_W_V.translation += Eigen::Vector3d(0, v * (s - std::tanh(s)), 8);
      return T_W_V;
    };
    EXPECT_LT(ErrorOver(26, Fly(plan)), 0.05) << v;
  }
}

// Points with known depth survive minutes on the ground.
TEST(EstimatorStandstill, TheMapOutlastsARest) {
  FlightPlan plan;
  plan.duration = 82;
  plan.T_W_V = [](double t) { return GentleFlight(t, 2, 12); };
  const EstimatedFlight flight = Fly(plan);
  EXPECT_TRUE(flight.outputs.back().stationary);
  EXPECT_GT(flight.outputs.back().counts.known_seen, 50);
}

}  // namespace
}  // namespace plm_vins
