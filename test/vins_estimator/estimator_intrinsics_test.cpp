// SPDX-License-Identifier: BSD-3-Clause
// Wrong intrinsics are estimated in flight, and then cost little accuracy.
#include <gtest/gtest.h>

#include "test/vins_estimator/estimated_flight.h"
#include "vins_estimator/map/recalibration.h"

namespace plm_vins {
namespace {

using testing::EstimatedFlight;
using testing::SimulatedFlight;

constexpr uint64_t kSeeds = 3;

simulator::FeatureSimulationOptions Options(uint64_t seed) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.trajectory.duration = 15;
  options.max_points = 80;
  return options;
}

// The flight as observed by trackers with a wrong calibration: focal lengths off by 1 %, principal
// point by 5 px.
SimulatedFlight WithWrongIntrinsics(SimulatedFlight flight) {
  const CameraParameters truth = flight.sensor.cameras[0].parameters;
  CameraParameters& wrong = flight.sensor.cameras[0].parameters;
  wrong.fx *= 1.01;
  wrong.fy *= 1.01;
  wrong.cx += 5;
  wrong.cy -= 5;
  const Recalibration recalibration(truth, wrong);
  for (FrameMeasurement& frame : flight.frames) recalibration.Move(0, &frame);
  return flight;
}

void ExpectIntrinsics(const CameraParameters& found, const CameraParameters& truth) {
  EXPECT_NEAR(found.fx / truth.fx, 1, 0.001);
  EXPECT_NEAR(found.fy / truth.fy, 1, 0.001);
  EXPECT_NEAR(found.cx, truth.cx, 1);
  EXPECT_NEAR(found.cy, truth.cy, 1);
}

EstimatedFlight Fly(const SimulatedFlight& simulated) {
  EstimatedFlight flight = testing::Estimate(simulated);
  EXPECT_TRUE(flight.restarts.empty());
  EXPECT_GT(flight.truth.size(), 230u) << "late start";
  return flight;
}

TEST(EstimatorIntrinsicsTest, AreFoundInFlight) {
  double right = 0, wrong = 0, found = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SimulatedFlight simulated = testing::SimulateFlight(Options(seed));
    right += testing::AbsoluteError(Fly(simulated)) / kSeeds;
    SimulatedFlight spoiled = WithWrongIntrinsics(simulated);
    wrong += testing::AbsoluteError(Fly(spoiled)) / kSeeds;
    spoiled.sensor.estimate_intrinsics = true;
    const EstimatedFlight flight = Fly(spoiled);
    found += testing::AbsoluteError(flight) / kSeeds;
    ExpectIntrinsics(flight.outputs.back().calibration.cameras[0].parameters,
                     simulated.sensor.cameras[0].parameters);
  }
  EXPECT_LT(found, 1.3 * right);
  EXPECT_GT(wrong, 3 * found);
}

TEST(EstimatorIntrinsicsTest, AreFoundWithARollingShutter) {
  auto options = Options(1);
  options.sensors.rolling_shutter = true;
  options.sensors.rolling_shutter_tr = 0.03;
  const SimulatedFlight simulated = testing::SimulateFlight(options);
  SimulatedFlight spoiled = WithWrongIntrinsics(simulated);
  spoiled.sensor.estimate_intrinsics = true;
  const Calibration found = Fly(spoiled).outputs.back().calibration;
  ExpectIntrinsics(found.cameras[0].parameters, simulated.sensor.cameras[0].parameters);
}

}  // namespace
}  // namespace plm_vins
