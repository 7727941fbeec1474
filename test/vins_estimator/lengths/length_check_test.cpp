// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lengths/length_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "test/vins_estimator/initialization/simulated_frames.h"

namespace plm_vins {
namespace {

using simulator::Motion;
using testing::SimulatedFlight;

simulator::FeatureSimulationOptions Options(Motion motion, uint64_t seed) {
  auto options = testing::FlightOptions(motion, seed);
  options.trajectory.duration = 12;
  options.max_points = 80;
  return options;
}

SimulatedFlight FlyInStereo(Motion motion, uint64_t seed) {
  auto options = Options(motion, seed);
  options.sensors.cameras = simulator::DefaultStereoSensors().cameras;
  return testing::SimulateFlight(options);
}

// Measured depths are `factor` times too long.
SimulatedFlight FlyWithDepth(Motion motion, uint64_t seed, double factor) {
  auto options = Options(motion, seed);
  options.sensors.depth.emplace();
  SimulatedFlight flight = testing::SimulateFlight(options);
  for (FrameMeasurement& frame : flight.frames) {
    for (PointObservation& point : frame.points.points) {
      if (point.depth) *point.depth *= factor;
    }
  }
  return flight;
}

// Scales the configured baseline.
void ScaleBaseline(double factor, SensorConfig* sensor) {
  Rigid3d T_C0_C1 = sensor->cameras[0].T_B_C.Inverse() * sensor->cameras[1].T_B_C;
  T_C0_C1.translation *= factor;
  sensor->cameras[1].T_B_C = sensor->cameras[0].T_B_C * T_C0_C1;
}

// The check at the end of a flight, and when it found the length wrong [s].
struct Checked {
  LengthCheck check;
  double wrong_after = 0;
};

Checked Check(const SimulatedFlight& flight) {
  const bool stereo = flight.sensor.cameras.size() > 1;
  Checked result{{flight.sensor, 0.5, stereo ? std::optional(StereoPair{0, 1}) : std::nullopt}};
  for (const FrameMeasurement& frame : flight.frames) {
    result.check.Add(frame);
    if (!result.check.is_wrong()) {
      result.wrong_after = ToSeconds(frame.t_ns - flight.frames[0].t_ns);
    }
  }
  return result;
}

TEST(LengthCheck, FindsTheRatioOfDepthsWithinTwoSeconds) {
  for (const double factor : {10.0, 5.0, 3.28, 0.1}) {
    for (const Motion motion : {Motion::kGentle, Motion::kFast}) {
      const auto [check, seconds] = Check(FlyWithDepth(motion, 2, factor));
      EXPECT_TRUE(check.is_wrong()) << factor;
      EXPECT_NEAR(check.ratio().log_ratio, std::log(factor), 3 * check.ratio().deviation);
      EXPECT_LT(seconds, 2) << factor;
    }
  }
}

TEST(LengthCheck, FindsTheRatioOfABaselineWithinTwoSeconds) {
  for (const double factor : {2.5, 0.5, 0.05}) {
    for (const Motion motion : {Motion::kGentle, Motion::kFast}) {
      SimulatedFlight flight = FlyInStereo(motion, 3);
      ScaleBaseline(factor, &flight.sensor);
      const auto [check, seconds] = Check(flight);
      EXPECT_TRUE(check.is_wrong()) << factor;
      EXPECT_NEAR(check.ratio().log_ratio, std::log(factor), 3 * check.ratio().deviation);
      EXPECT_LT(seconds, 2) << factor;
    }
  }
}

TEST(LengthCheck, FindsTenPercentInAVividFlight) {
  for (const double factor : {1.1, 0.9}) {
    EXPECT_TRUE(Check(FlyWithDepth(Motion::kFast, 1, factor)).check.is_wrong()) << factor;
    SimulatedFlight flight = FlyInStereo(Motion::kFast, 1);
    ScaleBaseline(factor, &flight.sensor);
    EXPECT_TRUE(Check(flight).check.is_wrong()) << factor;
  }
}

TEST(LengthCheck, FindsRightLengthsRight) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    for (const Motion motion : {Motion::kGentle, Motion::kFast, Motion::kHover}) {
      for (const SimulatedFlight& flight :
           {FlyInStereo(motion, seed), FlyWithDepth(motion, seed, 1)}) {
        const LengthCheck check = Check(flight).check;
        EXPECT_FALSE(check.is_wrong()) << seed;
        EXPECT_LT(check.ratio().contradiction, 4) << seed;
        EXPECT_TRUE(!check.is_open() || motion != Motion::kFast) << seed;
      }
    }
  }
}

TEST(LengthCheck, BelievesTheEstimatorIfTheOdometryAgrees) {
  SimulatedFlight flight = FlyInStereo(Motion::kGentle, 2);
  ScaleBaseline(1.06, &flight.sensor);
  const LengthCheck check = Check(flight).check;
  ASSERT_FALSE(check.is_wrong());
  const auto is_wrong = [&](const LengthEvidence& log_ratio) {
    LengthCheck told = check;
    told.Add(log_ratio);
    EXPECT_EQ(told.is_wrong(), told.contradiction() >= 5);
    return told.is_wrong();
  };
  EXPECT_TRUE(is_wrong({0.058, 0.011}));
  EXPECT_FALSE(is_wrong({0.058, 0.013})) << "uncertain";
  EXPECT_FALSE(is_wrong({0.045, 0.008})) << "small";
  EXPECT_FALSE(is_wrong({0.5, 0.05})) << "other";
  EXPECT_FALSE(is_wrong({-0.06, 0.011})) << "other";
}

TEST(LengthCheck, BelievesTheEstimatorWhereTheOdometryTellsNothing) {
  const auto told = [](const LengthEvidence& log_ratio) {
    LengthCheck check(simulator::DefaultStereoSensors(), 0.5, StereoPair{0, 1});
    check.Add(log_ratio);
    return check;
  };
  EXPECT_FALSE(told({0.2, 0.05}).is_wrong()) << "uncertain";
  EXPECT_FALSE(told({0.045, 0.002}).is_wrong()) << "small";
  for (const double error : {0.2, -0.2}) {
    const LengthCheck check = told({error, 0.02});
    EXPECT_TRUE(check.is_wrong());
    EXPECT_FALSE(check.KnowsRatio());
    EXPECT_EQ(check.IsTooLong(), error > 0);
    EXPECT_EQ(check.contradiction(), 5) << "just significant";
  }
}

// A turned camera shifts all disparities.
TEST(LengthCheck, ATurnedSecondCameraIsNoWrongBaseline) {
  for (const double angle : {0.005, -0.005}) {
    SimulatedFlight flight = FlyInStereo(Motion::kGentle, 2);
    Rigid3d& T_B_C1 = flight.sensor.cameras[1].T_B_C;
    T_B_C1.rotation = T_B_C1.rotation * SO3Exp(Eigen::Vector3d(0, angle, 0));
    EXPECT_FALSE(Check(flight).check.is_wrong()) << angle;
  }
}

}  // namespace
}  // namespace plm_vins
